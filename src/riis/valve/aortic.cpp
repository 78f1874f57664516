// SPDX-License-Identifier: Apache-2.0
// The aortic valve, with three cusps of four patches each (paper, 2.1 and table "Aortic valve parameters";
// docs/theory/aortic.md).
#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "valve/cusp.hpp"
#include "valve/valve.hpp"

namespace riis {
namespace {

// The positions in the list of specs below. First come the parameters of the whole valve, then those of each cusp, and last those
// of the open state.
// clang-format off
enum General {
  root_height, root_radius, leaflet_height, bending_height, t3_leaflet, t3_bending, t0_leaflet, t0_bending, xq, zq, opening,
  n_general
};
enum OfCusp {
  leaflet_radius_in, leaflet_radius_out, leaflet_angle, leaflet_power,
  bending_radius_in, bending_radius_out, bending_angle, bending_power,
  rotation, translation,
  n_of_cusp
};
// clang-format on
constexpr std::size_t n_cusps = 3;
const char *const cusp_names[n_cusps] = {"right", "left", "non_coronary"};
// The names of the cusps in messages. The names are character constants, because a std::string is needed only if a check fails.
const char *const cusps[n_cusps] = {"the right cusp", "the left cusp", "the non_coronary cusp"};
constexpr std::size_t open_radius_ratio = n_general + n_cusps * n_of_cusp, commissure_expansion = open_radius_ratio + 1;
// With these defaults the orifice is 3.9 cm2, and no free edge changes its length by more than 5 % (docs/theory/aortic.md).
constexpr CuspOpening default_opening{0.75, 0.05};

std::size_t position_of(std::size_t cusp, OfCusp parameter) { return n_general + cusp * n_of_cusp + parameter; }

// The rules for rotations that the caller did not set. If the sum of the leaflet angles is 180 degrees, neighbouring cusps meet
// at their commissures. With any other sum, the three gaps or overlaps between neighbouring cusps are equal.
double leaflet_angle_of(const ParameterValues &values, std::size_t cusp) {
  return values[position_of(cusp, leaflet_angle)][0];
}
// Returns the angle from the right cusp's symmetry plane to the symmetry plane of its neighbour.
double turn_from_right(const ParameterValues &values, std::size_t neighbour) {
  const double sum = leaflet_angle_of(values, 0) + leaflet_angle_of(values, 1) + leaflet_angle_of(values, 2);
  return leaflet_angle_of(values, 0) + leaflet_angle_of(values, neighbour) + 2 * (180 - sum) / 3;
}
std::array<double, 3> left_rotation(const ParameterValues &values) { return {0, 0, turn_from_right(values, 1)}; }
std::array<double, 3> non_coronary_rotation(const ParameterValues &values) {
  return {0, 0, -turn_from_right(values, 2)};
}
const ParameterRule rotation_rules[n_cusps] = {
    {nullptr, nullptr},
    {"0, 0, right.leaflet_angle + left.leaflet_angle + 2/3 (180 - sum of all leaflet_angle)", left_rotation},
    {"0, 0, -(right.leaflet_angle + non_coronary.leaflet_angle) - 2/3 (180 - sum of all leaflet_angle)",
     non_coronary_rotation}};

// The paper's values of the cusps. The value of `translation` is the translation along the axis.
constexpr double table[n_cusps][n_of_cusp] = {{0.24, 1.365, 61.0, 1.58, 0.40, 1.390, 47.30, 1.82, 0.0, -1},
                                              {0.49, 1.495, 58.5, 2.77, 0.74, 1.355, 43.00, 4.12, 119.5, -1},
                                              {0.20, 1.380, 60.5, 1.19, 0.67, 1.435, 42.75, 2.54, -121.5, -1}};

// The rules for exponents that the caller did not set. With an exponent above its bound, the free edge reaches into the next
// cusp, beyond the plane through the axis and the commissure. The paper's right and left exponents are above their bounds. The
// rules for these two exponents keep the paper's ratio of exponent to bound.
double power_bound(double radius_in, double radius_out, double angle) {
  const double x = radius_out * sine_cosine_degrees(angle).cosine;
  return x > radius_in ? x / (x - radius_in) : std::numeric_limits<double>::infinity();
}
template <std::size_t cusp>
std::array<double, 3> power_rule(const ParameterValues &values) {
  const double(&own)[n_of_cusp] = view(table)[cusp];
  const auto value = [&](OfCusp parameter) { return values[position_of(cusp, parameter)][0]; };
  const double of_paper = power_bound(own[leaflet_radius_in], own[leaflet_radius_out], own[leaflet_angle]);
  const double bound = power_bound(value(leaflet_radius_in), value(leaflet_radius_out), value(leaflet_angle));
  return {own[leaflet_power] * std::min(1.0, bound / std::min(own[leaflet_power], of_paper))};
}
const ParameterRule power_rules[n_cusps] = {{"1.58 min(1, b / 1.569), b = x / (x - right.leaflet_radius_in), x = "
                                             "right.leaflet_radius_out cos(right.leaflet_angle)",
                                             power_rule<0>},
                                            {"2.77 min(1, b / 2.683), b = x / (x - left.leaflet_radius_in), x = "
                                             "left.leaflet_radius_out cos(left.leaflet_angle)",
                                             power_rule<1>},
                                            {"min(1.19, x / (x - non_coronary.leaflet_radius_in)), x = "
                                             "non_coronary.leaflet_radius_out cos(non_coronary.leaflet_angle)",
                                             power_rule<2>}};

void check_values(const ParameterValues &values);
PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening);

// clang-format off
ValveKind make_kind() {
  // The limits of lengths allow a valve in any unit from kilometres to micrometres. The ratios of lengths are checked by
  // check_together.
  constexpr double shortest = 1e-9, longest = 1e9;
  const char *length = "length", *degree = "degree", *number = "1";
  ValveKind kind{"aortic", {
    {"root_height", length, "height of the root; unused, because the translations place the cusps", 1, {1}, 0, longest},
    {"root_radius", length, "radius of the root, where the cusps are attached", 1, {1.29}, shortest, longest,
     {}, {"annulus", 2}},
    {"leaflet_height", length, "height of the free edge above the root", 1, {1.02}, shortest, longest,
     {}, {"effective_height", 1}},
    {"bending_height", length, "height of the bending curve above the root", 1, {0.71}, shortest, longest},
    {"t3_leaflet", length, "length of the free edge's tangent at the commissure, for each cusp", 3, {0.5, 0.5, 0.65}, 0, longest},
    {"t3_bending", length, "length of the bending curve's tangent at the sinus, for each cusp", 3, {0.55, 0.23, 0.4}, 0, longest},
    {"t0_leaflet", length, "length of the free edge's tangent at the symmetry plane, for each cusp",
     3, {0.025, 0.1, 0.1}, 0, longest},
    {"t0_bending", length, "length of the bending curve's tangent at the symmetry plane, for each cusp",
     3, {0.1, 0.1, 0.1}, 0, longest},
    {"xq", number, "radial position of the first inner control point of the symmetry curve", 1, {-0.2}, -10, 10},
    {"zq", number, "vertical position of the first inner control point of the symmetry curve", 1, {-0.2}, -10, 10},
    opening_spec("from 0 (closed) to 1 (open); riis_valve_set_open_state, or open_radius_ratio and commissure_expansion, give "
                 "the open state", 0),
  }, opening, true, check_values, make_patches, nullptr};
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
    const std::string of = std::string(cusp_names[cusp]) + ".";
    const double *value = table[cusp];
    kind.parameters.insert(kind.parameters.end(), {
      {of + "leaflet_radius_in", length, "radius of the free edge at the symmetry plane",
       1, {value[leaflet_radius_in]}, 0, longest},
      {of + "leaflet_radius_out", length, "radius of the free edge's end, at the commissure",
       1, {value[leaflet_radius_out]}, shortest, longest, {}, {"stj", 2}},
      {of + "leaflet_angle", degree, "angle from the symmetry plane to the free edge's end", 1, {value[leaflet_angle]}, 5, 175},
      {of + "leaflet_power", number, "exponent of the free edge's profile", 1, {value[leaflet_power]}, 1, 20,
       power_rules[cusp]},
      {of + "bending_radius_in", length, "radius of the bending curve at the symmetry plane",
       1, {value[bending_radius_in]}, 0, longest},
      {of + "bending_radius_out", length, "radius of the bending curve's end, at the sinus",
       1, {value[bending_radius_out]}, shortest, longest},
      {of + "bending_angle", degree, "angle from the symmetry plane to the bending curve's end",
       1, {value[bending_angle]}, 5, 175},
      {of + "bending_power", number, "exponent of the bending curve's profile", 1, {value[bending_power]}, 1, 20},
      {of + "rotation", degree, "rotation of the cusp about x, then y, then z", 3, {0, 0, value[rotation]}, -360, 360,
       rotation_rules[cusp]},
      {of + "translation", length, "shift of the cusp after its rotation", 3, {0, 0, value[translation]}, -longest, longest},
    });
  }
  for (ParameterSpec &spec : cusp_opening_specs(default_opening)) kind.parameters.push_back(std::move(spec));
  kind.has_exact_contacts = true;
  return kind;
}
// clang-format on

CuspShape shape_of(const ParameterValues &values, std::size_t cusp) {
  const auto general = [&](General parameter, std::size_t i = 0) { return values[parameter][i]; };
  const auto own = [&](OfCusp parameter) { return values[position_of(cusp, parameter)][0]; };
  return {general(root_radius),
          general(leaflet_height),
          general(bending_height),
          general(xq),
          general(zq),
          {own(leaflet_radius_in), own(leaflet_radius_out), own(leaflet_angle), own(leaflet_power),
           general(t0_leaflet, cusp), general(t3_leaflet, cusp)},
          {own(bending_radius_in), own(bending_radius_out), own(bending_angle), own(bending_power),
           general(t0_bending, cusp), general(t3_bending, cusp)}};
}

CuspOpening opening_of(const ParameterValues &values) {
  return {values[open_radius_ratio][0], values[commissure_expansion][0]};
}

// Compares lengths with the root radius, and heights with one another.
void check_together(const ParameterValues &values) {
  const Reference radius{"root_radius", values[root_radius][0]}, height{"leaflet_height", values[leaflet_height][0]};
  const auto check = [&](std::size_t position, const Reference &reference, double least, double most) {
    check_ratio(aortic_valve_kind().parameters[position], values[position], reference, least, most);
  };
  check(leaflet_height, radius, 0.05, 10);
  check(bending_height, height, 0.05, 0.95);
  for (const General parameter : {t3_leaflet, t3_bending, t0_leaflet, t0_bending}) check(parameter, radius, 0, 10);
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
    for (const OfCusp parameter : {leaflet_radius_in, bending_radius_in})
      check(position_of(cusp, parameter), radius, 0, 10);
    for (const OfCusp parameter : {leaflet_radius_out, bending_radius_out})
      check(position_of(cusp, parameter), radius, 0.05, 10);
    check(position_of(cusp, translation), radius, 0, 100);
  }
}

// Checks every curve of one state. The curves at other openings need no check, because they lie between the curves of the closed
// and the open state, which are both checked.
void check_values(const ParameterValues &values) {
  check_together(values);
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
    const CuspShape shape = shape_of(values, cusp);
    check_reach(half_cusp(shape), shape, "", cusps[cusp], "");
  }
}

// Returns half a cusp of the open state that the valve's own parameters define.
HalfCusp open_half_of(const ParameterValues &values, std::size_t cusp) {
  return half_cusp(open_shape(shape_of(values, cusp), opening_of(values)));
}

HalfCusp own_open_half(const ParameterValues &values, std::size_t cusp) {
  const CuspShape shape = open_shape(shape_of(values, cusp), opening_of(values));
  const HalfCusp half = half_cusp(shape);
  check_reach(half, shape, "in the open state, ", cusps[cusp], ", open_radius_ratio, commissure_expansion");
  return half;
}

PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening) {
  const bool has_own_open_state = &open == &closed;
  PatchSet set;
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
    const HalfCusp closed_half = half_cusp(shape_of(closed.values, cusp));
    // At opening 0, the open state of the valve's own parameters is not made. A closed valve does not need this state, and the
    // state might be refused.
    const HalfCusp open_half = !has_own_open_state ? half_cusp(shape_of(open.values, cusp))
                               : opening != 0      ? own_open_half(closed.values, cusp)
                                                   : open_half_of(closed.values, cusp);
    // The position of a cusp is given by angles and a shift, so these are blended instead of control points.
    const auto vector_of = [&](OfCusp parameter) {
      const std::size_t i = position_of(cusp, parameter);
      return riis::blend(riis::vector_of(closed.values[i]), riis::vector_of(open.values[i]), opening);
    };
    add_cusps(set, {{blend(closed_half, open_half, opening)}, {rate(closed_half, open_half)}},
              {{rotation_xyz(vector_of(rotation)), vector_of(translation), static_cast<std::int32_t>(cusp)}});
  }
  return set;
}

}  // namespace

const ValveKind &aortic_valve_kind() {
  // The kind is made at its first use. It is never destroyed, so that it serves until the process ends.
  static const ValveKind &kind = *new ValveKind(with_skirt(make_kind(), SkirtAxis::of_cusp));
  return kind;
}

}  // namespace riis
