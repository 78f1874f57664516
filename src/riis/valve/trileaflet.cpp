// SPDX-License-Identifier: Apache-2.0
// The trileaflet valve. Its three equal cusps close completely: their free edges meet along straight lines from the commissures
// to the axis (docs/theory.md, section 3).
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
// The angles of the right, the left and the non-coronary cusp about the axis, in degrees. This is their order round the axis.
constexpr double turns[3] = {0, 120, -120};

void check_values(const ParameterValues &values);
PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening);

// Lengths are in centimetres. Sources of the values (docs/theory.md has more): the root from Roman et al. 1989, the cylinder
// between Thubrikar et al. 1981 and Jelenc et al. 2024, the heights from Bierbach et al. 2010 and Schaefers et al. 2013, the
// orifice from Bonow et al. 2006, and the expansion of the commissures from Pang et al. 2000. The bending curve is chosen to fit
// these.
// clang-format off
ValveKind make_kind() {
  constexpr double shortest = 1e-9, longest = 1e9;
  const char *length = "length", *degree = "degree", *number = "1";
  ValveKind kind{"trileaflet", {
    {"root_radius", length, "radius of the root, where the cusps are attached", 1, {1.25}, shortest, longest},
    {"leaflet_radius_out", length, "radius of the commissures, and half the length of a free edge", 1, {1.25}, shortest, longest},
    {"leaflet_height", length, "height of the free edges above the root", 1, {1.2}, shortest, longest},
    {"bending_height", length, "height of the bending curve above the root", 1, {0.6}, shortest, longest},
    {"bending_radius_in", length, "radius of the bending curve at the symmetry plane", 1, {0.4}, 0, longest},
    {"bending_radius_out", length, "radius of the bending curve's end, at the sinus", 1, {1.275}, shortest, longest},
    {"bending_angle", degree, "angle from the symmetry plane to the bending curve's end", 1, {35}, 5, half_angle},
    {"bending_power", number, "exponent of the bending curve's profile", 1, {1.8}, 1, 20},
    {"t0_bending", length, "start tangent of the bending curve", 1, {0.25}, 0, longest},
    {"t3_bending", length, "end tangent of the bending curve", 1, {0.25}, 0, longest},
    {"xq", number, "radial place of the symmetry curve's first inner control point", 1, {-0.22}, -10, 10},
    {"zq", number, "vertical place of the symmetry curve's first inner control point", 1, {-0.35}, -10, 10},
    {"translation", length, "shift of the valve", 3, {0, 0, -1.2}, -longest, longest},
    opening_spec("0 closed to 1 open", 0),
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

// Checks both states, because one set of values defines both.
void check_values(const ParameterValues &values) {
  const Measure radius{"root_radius", values[root_radius][0]}, height{"leaflet_height", values[leaflet_height][0]};
  const auto check = [&](Parameter parameter, const Measure &measure, double least, double most) {
    check_ratio(trileaflet_valve_kind().parameters[parameter], values[parameter], measure, least, most);
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

// Sews the cusps together. The half y < 0 of a cusp meets the half y >= 0 of the cusp before it. At opening 0 they meet along
// the free edge, otherwise only at the commissure.
void sew(PatchSet &set, bool is_closed) {
  const std::size_t top = set.patches.size() - 1;
  constexpr std::size_t right = 0, left = 1, non_coronary = 2;
  for (const auto &[cusp, before] :
       {std::pair(right, non_coronary), std::pair(left, right), std::pair(non_coronary, left)})
    set.seams.push_back({top, 2 * cusp + 1, 2 * before, is_closed ? SeamPlace::side_v1 : SeamPlace::corner});
}

PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening) {
  const HalfCusp closed_half = half_cusp(closed_shape(closed.values)), open_half = half_cusp(open_shape(open.values));
  const auto &from = closed.values[translation], &to = open.values[translation];
  const Vec3 shift = riis::blend(Vec3{from[0], from[1], from[2]}, Vec3{to[0], to[1], to[2]}, opening);
  Vector<CuspPlace> places;
  for (std::int32_t cusp = 0; cusp < 3; ++cusp)
    // Adding 0 turns -0 into 0, so that the cusps have the same bits where they meet on the axis.
    places.push_back({rotation_xyz({0, 0, view(turns)[cusp]}), shift + Vec3{0, 0, 0}, cusp});
  PatchSet set;
  add_cusps(set, blend(closed_half, open_half, opening), rate(closed_half, open_half), places);
  sew(set, opening == 0);
  return set;
}

}  // namespace

const ValveKind &trileaflet_valve_kind() {
  // The kind is made when it is first used, and it is never destroyed. So it can be used during the whole life of the process.
  static const ValveKind &kind = *new ValveKind(with_skirt(make_kind(), SkirtAxis::of_cusp));
  return kind;
}

}  // namespace riis
