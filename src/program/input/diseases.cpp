// SPDX-License-Identifier: Apache-2.0
#include "program/input/valve_file.hpp"

#include <algorithm>
#include <iterator>

#include "program/base/text.hpp"

namespace riis::program {
namespace {

// A parameter without a part's name, such as "width", is set for all bumps or for all commissures.
// clang-format off
const Disease diseases[] = {
    {"aortic_stenosis_mild", "coapting",
     R"({"bump_0": {"leaflet": 0}, "bump_1": {"leaflet": 1}, "bump_2": {"leaflet": 2}, "width": 1, "open": 0.376})",
     1, 1.75, "three stiff cusps, as by lime"},
    {"aortic_stenosis_moderate", "coapting",
     R"({"bump_0": {"leaflet": 0}, "bump_1": {"leaflet": 1}, "bump_2": {"leaflet": 2}, "width": 1, "open": 0.253})",
     1, 1.25, "the same"},
    {"aortic_stenosis_severe", "coapting",
     R"({"bump_0": {"leaflet": 0}, "bump_1": {"leaflet": 1}, "bump_2": {"leaflet": 2}, "width": 1, "open": 0.137})",
     1, 0.8, "the same"},
    {"aortic_stenosis_rheumatic", "coapting",
     R"({"open_radius_ratio": 0.6, "fusion": 0.568})",
     1, 0.8, "three fused commissures"},
    {"aortic_cusp_restricted", "coapting",
     R"({"bump_0": {"leaflet": 0, "width": 1, "open": 0.304}})",
     1, 3.4, "one stiff cusp"},
    {"bicuspid_type_0", "bicuspid",
     R"({"annulus": 2.741})",
     1, 3.8, "two equal cusps"},
    {"bicuspid_type_1", "bicuspid",
     R"({"annulus": 2.7, "cusp_0": {"sector": 210}, "cusp_1": {"sector": 150},
         "bump_0": {"leaflet": 0, "width": 0.25, "open": 0.044}})",
     1, 2.8, "a wide cusp with a raphe"},
    {"bicuspid_stenosis_mild", "bicuspid",
     R"({"annulus": 2.7, "cusp_0": {"sector": 210}, "cusp_1": {"sector": 150},
         "bump_0": {"leaflet": 0, "width": 0.25, "open": 0}, "fusion": 0.186})",
     1, 1.75, "a stiff raphe, and both commissures fused"},
    {"bicuspid_stenosis_moderate", "bicuspid",
     R"({"annulus": 2.7, "cusp_0": {"sector": 210}, "cusp_1": {"sector": 150},
         "bump_0": {"leaflet": 0, "width": 0.25, "open": 0}, "fusion": 0.28})",
     1, 1.25, "the same"},
    {"bicuspid_stenosis_severe", "bicuspid",
     R"({"annulus": 2.7, "cusp_0": {"sector": 210}, "cusp_1": {"sector": 150},
         "bump_0": {"leaflet": 0, "width": 0.25, "open": 0}, "fusion": 0.382})",
     1, 0.8, "the same"},
    {"quadricuspid_type_a", "quadricuspid",
     R"({"annulus": 2.421})",
     1, 4.0, "four equal cusps"},
    {"quadricuspid_type_b", "quadricuspid",
     R"({"annulus": 2.418, "cusp_3": {"sector": 60}})",
     1, 4.0, "three equal cusps and a smaller one"},
    {"quadricuspid_regurgitation", "quadricuspid",
     R"({"bump_0": {"leaflet": 0}, "bump_1": {"leaflet": 1},
         "bump_2": {"leaflet": 2}, "bump_3": {"leaflet": 3}, "closed": 0.054})",
     0, 0.2, "four cusps that do not meet in the middle"},
    {"aortic_regurgitation_mild", "coapting",
     R"({"bump_0": {"leaflet": 0}, "bump_1": {"leaflet": 1}, "bump_2": {"leaflet": 2}, "closed": 0.016})",
     0, 0.08, "a gap in the middle"},
    {"aortic_regurgitation_moderate", "coapting",
     R"({"bump_0": {"leaflet": 0}, "bump_1": {"leaflet": 1}, "bump_2": {"leaflet": 2}, "closed": 0.061})",
     0, 0.2, "the same"},
    {"aortic_regurgitation_severe", "coapting",
     R"({"bump_0": {"leaflet": 0}, "bump_1": {"leaflet": 1}, "bump_2": {"leaflet": 2}, "closed": 0.135})",
     0, 0.4, "the same"},
    {"aortic_regurgitation_commissural", "coapting",
     R"({"bump_0": {"commissure": 0, "closed": 0.533}})",
     0, 0.15, "a gap at a commissure"},
    {"aortic_cusp_prolapse", "coapting",
     R"({"cusp_2": {"effective_height": 0.6}})",
     0, 0, "the free edge of a cusp lies 0.3 cm too low"},
    {"mitral_stenosis_mild", "mitral_coapting",
     R"({"bump_0": {"commissure": 0}, "bump_1": {"commissure": 1}, "width": 0.642, "open": 0})",
     1, 1.75, "both commissures fused, rheumatic"},
    {"mitral_stenosis_moderate", "mitral_coapting",
     R"({"bump_0": {"commissure": 0}, "bump_1": {"commissure": 1}, "width": 0.701, "open": 0})",
     1, 1.25, "the same"},
    {"mitral_stenosis_severe", "mitral_coapting",
     R"({"bump_0": {"commissure": 0}, "bump_1": {"commissure": 1}, "width": 0.763, "open": 0})",
     1, 0.8, "the same"},
    {"mitral_regurgitation_mild", "mitral_coapting",
     R"({"bump_0": {"leaflet": 1, "width": 0.5, "closed": 0.159}})",
     0, 0.15, "the posterior leaflet does not reach the anterior one"},
    {"mitral_regurgitation_moderate", "mitral_coapting",
     R"({"bump_0": {"leaflet": 1, "width": 0.5, "closed": 0.319}})",
     0, 0.3, "the same"},
    {"mitral_regurgitation_severe", "mitral_coapting",
     R"({"bump_0": {"leaflet": 1, "width": 0.5, "closed": 0.494}})",
     0, 0.5, "the same"},
    {"mitral_tethering", "mitral_coapting",
     R"({"bump_0": {"leaflet": 0}, "bump_1": {"leaflet": 1}, "width": 0.6, "closed": 0.174, "lift": -0.4})",
     0, 0.4, "chords pull both leaflets into the ventricle"},
    {"mitral_clip", "mitral_coapting",
     R"({"bump_0": {"leaflet": 0}, "bump_1": {"leaflet": 1}, "width": 0.205, "open": 0})",
     1, 2.5, "A2 clipped to P2: two orifices"},
    {"mitral_prolapse_P2", "mitral_coapting",
     R"({"bump_0": {"leaflet": 1, "u": 0.333}, "bump_1": {"leaflet": 1, "u": 0.5},
         "bump_2": {"leaflet": 1, "u": 0.667}, "width": 0.2, "lift": 0.7})",
     0, 0, "P2 bulges above the annulus"},
    {"mitral_flail_P2", "mitral_coapting",
     R"({"bump_0": {"leaflet": 1, "u": 0.333}, "bump_1": {"leaflet": 1, "u": 0.5},
         "bump_2": {"leaflet": 1, "u": 0.667}, "width": 0.2, "lift": 1.2})",
     0, 0, "the free edge of P2 lies above the annulus"},
    {"tricuspid_regurgitation_moderate", "tricuspid",
     R"({"AP_diameter": 4.6, "SL_diameter": 4.111})",
     0, 0.3, "a dilated annulus"},
    {"tricuspid_regurgitation_severe", "tricuspid",
     R"({"AP_diameter": 4.6, "SL_diameter": 4.267})",
     0, 0.5, "the same"},
    {"tricuspid_regurgitation_torrential", "tricuspid",
     R"({"AP_diameter": 4.6, "SL_diameter": 4.503})",
     0, 0.9, "the same"},
};
// clang-format on

}  // namespace

const Disease *disease_named(const std::string &name) {
  const Disease *const found = std::find_if(std::begin(diseases), std::end(diseases),
                                            [&](const Disease &disease) { return name == disease.name; });
  return found == std::end(diseases) ? nullptr : found;
}

std::string table_of_diseases() {
  std::string table;
  const auto column = [&](const std::string &text, std::size_t width) {
    table += text + std::string(width - std::min(width, text.size()), ' ') + " ";
  };
  for (const Disease &disease : diseases) {
    column(disease.name, 34);
    column(disease.kind, 15);
    column(disease.area == 0 ? "" : (disease.opening == 0 ? "gap " : "open ") + shortest(disease.area), 9);
    table += std::string(disease.diagnosis) + "\n";
  }
  return table;
}

}  // namespace riis::program
