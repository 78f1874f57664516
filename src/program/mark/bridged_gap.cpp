// SPDX-License-Identifier: Apache-2.0
#include "program/mark/bridged_gap.hpp"

#include <utility>

#include "program/base/handles.hpp"
#include "program/base/text.hpp"
#include "program/commands/commands.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/warnings.hpp"

namespace riis::program {
namespace {

// Differences below this share of the outline's area come from the triangles. What the bands leave of both valves has a smaller
// error, because it is mostly 0.
constexpr double least_share = 1e-3, least_share_left = 1e-5;
// The width of a gap is found to this share of the bridge.
constexpr int n_halvings = 10;

// Takes all bumps from their places. Returns whether one had a place.
bool remove_bumps(riis_valve *valve) {
  bool has_bump = false;
  for (const riis_parameter &parameter : all_parameters(valve)) {
    const std::string name = parameter.name;
    const bool is_place =
        name.rfind("bump_", 0) == 0 && (has_ending(name, ".leaflet") || has_ending(name, ".commissure"));
    if (!is_place || values_of(valve, parameter)[0] == parameter.default_values[0]) continue;
    check(riis_valve_unset(valve, parameter.name));
    has_bump = true;
  }
  return has_bump;
}

// Returns the closed valve with a band that does not step aside, or null if the valve cannot close.
Surface closed_surface(const ValveOptions &options, riis_valve *valve) {
  check(riis_valve_set_scalar(valve, "opening", 0));
  riis_surface_options how = own_frame(options);
  how.offset = 0;
  how.measure = RIIS_MEASURE_TRIANGLES;
  how.measure_tolerance = RIIS_AUTO;
  how.triangulation = RIIS_TRIANGULATION_ADAPTED;
  Surface surface;
  if (riis_surface_create(valve, &how, surface.out()) != RIIS_OK) return nullptr;
  return surface;
}

// Returns the orifice, and as effective area what is left of it after its edge along the leaflets has moved inwards.
riis_orifice orifice_of(const riis_surface *surface, double moved, double rim_reach) {
  auto resistance = defaults<riis_resistance>();
  resistance.half_thickness = moved / rim_reach;
  return get<riis_orifice>(riis_surface_get_orifice, surface, &resistance);
}

}  // namespace

void warn_of_bridged_gap(const ValveOptions &options, const riis_valve *valve, const std::string &part) {
  const Valve healthy = copy_of(valve);
  if (!remove_bumps(healthy)) return;
  const Valve sick = copy_of(valve);
  const Surface with_gap = closed_surface(options, sick), without_gap = closed_surface(options, healthy);
  if (!with_gap || !without_gap) return;
  const double bridged = 1 - options.surface_options.offset;  // in half thicknesses, on either side of the gap
  const double reach = bridged * info_of(with_gap).half_thickness;
  // The share of the half thickness by which a rim's band reaches inwards is the same for all half thicknesses.
  const auto resistance = defaults<riis_resistance>();
  const double rim_reach = get<riis_orifice>(riis_surface_get_orifice, with_gap, &resistance).rim_reach;
  const auto is_open = [](const riis_orifice &left, const riis_orifice &usual) {
    return left.effective_area - usual.effective_area > least_share_left * usual.outline_area;
  };
  const riis_orifice whole = orifice_of(with_gap, reach, rim_reach), usual = orifice_of(without_gap, reach, rim_reach);
  const double gap = whole.area - usual.area;
  if (gap <= least_share * usual.outline_area || is_open(whole, usual)) return;
  double open = 0, closed = reach;
  for (int i = 0; i < n_halvings; ++i) {
    const double middle = 0.5 * (open + closed);
    const bool is_wider = is_open(orifice_of(with_gap, middle, rim_reach), orifice_of(without_gap, middle, rim_reach));
    (is_wider ? open : closed) = middle;
  }
  warn((part.empty() ? "" : part + ": ") + "bumps leave a gap of " + shown(gap) +
       " in the closed valve, which is at most " + shown(2 * closed) + " wide, and the band closes gaps of up to " +
       shown(2 * reach) + ", " + shown(2 * bridged) + " half thicknesses; a half thickness below " +
       shown(closed / bridged) + " leaves it open");
}

}  // namespace riis::program
