// SPDX-License-Identifier: Apache-2.0
// The trileaflet valve. The three equal cusps of this valve close completely: their free edges meet along straight lines from the
// commissures to the axis (docs/theory/trileaflet.md).
#include <utility>

#include "common/array_view.hpp"
#include "geometry/placement.hpp"
#include "valve/cusp.hpp"
#include "valve/valve.hpp"

namespace riis {
namespace {

// Positions in the list of specs below.
// clang-format off
enum Parameter {
  root_radius, leaflet_radius_out, leaflet_height, bending_height, bending_radius_in, bending_radius_out, bending_angle,
  bending_power, t0_bending, t3_bending, xq, zq, translation, opening, open_radius_ratio, commissure_expansion
};
// clang-format on

// Half the angle of a cusp in degrees, from its symmetry plane to the end of its free edge.
constexpr double half_angle = 60;

// The rules for sizes that the caller did not set. Without these rules, the cusps would cross if a caller changed other sizes
// (docs/theory/trileaflet.md).
using Rule = std::array<double, 3>;
Rule bending_height_rule(const ParameterValues &values) { return {0.5 * values[leaflet_height][0]}; }
Rule bending_radius_in_rule(const ParameterValues &values) { return {0.32 * values[root_radius][0]}; }
Rule bending_radius_out_rule(const ParameterValues &values) {
  return {0.51 * (values[root_radius][0] + values[leaflet_radius_out][0])};
}
Rule tangent_rule(const ParameterValues &values) { return {0.2 * values[root_radius][0]}; }

void check_values(const ParameterValues &values);
PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening);

// The defaults of lengths are in centimetres, and docs/theory/trileaflet.md lists the sources of the defaults. The root follows
// Roman et al. 1989. The heights follow Bierbach et al. 2010 and Schaefers et al. 2013. The orifice follows Bonow et al. 2006,
// and the expansion of the commissures follows Pang et al. 2000. Root and commissures have equal radii, because their measured
// ratio is 1.11 in Jelenc et al. 2024 and 1/1.2 in Thubrikar et al. 1981. The bending curve is chosen to fit these values.
// clang-format off
ValveKind make_kind() {
  constexpr double shortest = 1e-9, longest = 1e9;
  const char *length = "length", *degree = "degree", *number = "1";
  ValveKind kind{"trileaflet", {
    {"root_radius", length, "radius of the root, where the cusps are attached", 1, {1.25}, shortest, longest,
     {}, {"annulus", 2}},
    {"leaflet_radius_out", length, "radius of the commissures, and half the length of a free edge", 1, {1.25}, shortest, longest,
     {}, {"stj", 2}},
    {"leaflet_height", length, "height of the free edges above the root", 1, {1.2}, shortest, longest,
     {}, {"effective_height", 1}},
    {"bending_height", length, "height of the bending curve above the root", 1, {0.6}, shortest, longest,
     {"0.5 leaflet_height", bending_height_rule}},
    {"bending_radius_in", length, "radius of the bending curve at the symmetry plane", 1, {0.4}, 0, longest,
     {"0.32 root_radius", bending_radius_in_rule}},
    {"bending_radius_out", length, "radius of the bending curve's end, at the sinus", 1, {1.275}, shortest, longest,
     {"0.51 (root_radius + leaflet_radius_out)", bending_radius_out_rule}},
    {"bending_angle", degree, "angle from the symmetry plane to the bending curve's end", 1, {35}, 5, half_angle},
    {"bending_power", number, "exponent of the bending curve's profile", 1, {1.8}, 1, 20},
    {"t0_bending", length, "start tangent of the bending curve", 1, {0.25}, 0, longest, {"0.2 root_radius", tangent_rule}},
    {"t3_bending", length, "end tangent of the bending curve", 1, {0.25}, 0, longest, {"0.2 root_radius", tangent_rule}},
    {"xq", number, "radial position of the first inner control point of the symmetry curve", 1, {-0.22}, -10, 10},
    {"zq", number, "vertical position of the first inner control point of the symmetry curve", 1, {-0.35}, -10, 10},
    {"translation", length, "shift of the valve", 3, {0, 0, -1.2}, -longest, longest},
    opening_spec("from 0 (closed) to 1 (open)", 0),
  }, opening, true, check_values, make_patches, nullptr};
  for (ParameterSpec &spec : cusp_opening_specs({0.8, 0.1})) kind.parameters.push_back(std::move(spec));
  kind.has_exact_contacts = true;
  return kind;
}
// clang-format on

CuspShape closed_shape(const ParameterValues &values) {
  const auto value = [&](Parameter parameter) { return values[parameter][0]; };
  const double third = value(leaflet_radius_out) * sine_cosine_degrees(half_angle).sine / 3;
  return {value(root_radius),
          value(leaflet_height),
          value(bending_height),
          value(xq),
          value(zq),
          {0, value(leaflet_radius_out), half_angle, 1, third, third},
          {value(bending_radius_in), value(bending_radius_out), value(bending_angle), value(bending_power),
           value(t0_bending), value(t3_bending)}};
}

CuspShape open_shape(const ParameterValues &values) {
  return riis::open_shape(closed_shape(values), {values[open_radius_ratio][0], values[commissure_expansion][0]});
}

// Checks the closed and the open state, because one set of values defines both.
void check_values(const ParameterValues &values) {
  const Reference radius{"root_radius", values[root_radius][0]}, height{"leaflet_height", values[leaflet_height][0]};
  const auto check = [&](Parameter parameter, const Reference &reference, double least, double most) {
    check_ratio(trileaflet_valve_kind().parameters[parameter], values[parameter], reference, least, most);
  };
  check(leaflet_height, radius, 0.05, 10);
  check(bending_height, height, 0.05, 0.95);
  for (const Parameter parameter : {t0_bending, t3_bending, bending_radius_in}) check(parameter, radius, 0, 10);
  for (const Parameter parameter : {leaflet_radius_out, bending_radius_out}) check(parameter, radius, 0.05, 10);
  check(translation, radius, 0, 100);
  const CuspShape closed = closed_shape(values), open = open_shape(values);
  check_reach(half_cusp(closed), closed, "", "a cusp", "");
  check_reach(half_cusp(open), open, "in the open state, ", "a cusp", ", open_radius_ratio, commissure_expansion");
}

PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening) {
  const HalfCusp closed_half = half_cusp(closed_shape(closed.values)), open_half = half_cusp(open_shape(open.values));
  const Vec3 shift = riis::blend(vector_of(closed.values[translation]), vector_of(open.values[translation]), opening);
  PatchSet set;
  add_cusps(set, {{blend(closed_half, open_half, opening)}, {rate(closed_half, open_half)}}, equal_places(3, shift));
  // At opening 0 the cusps are sewn together along their free edges. At other openings they are sewn together only at the
  // commissures.
  sew_equal_cusps(set, top_patch(set), opening == 0 ? SeamPlace::side_v1 : SeamPlace::corner);
  return set;
}

}  // namespace

const ValveKind &trileaflet_valve_kind() {
  // The kind is made at its first use. It is never destroyed, so that it serves until the process ends.
  static const ValveKind &kind = *new ValveKind(with_skirt(make_kind(), SkirtAxis::of_cusp));
  return kind;
}

}  // namespace riis
