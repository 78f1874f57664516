// SPDX-License-Identifier: Apache-2.0
#include "valve/aortic.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/array_view.hpp"
#include "base/errors.hpp"
#include "geometry/placement.hpp"
#include "valve/patches.hpp"

namespace riis {
namespace {

// Positions in the list of specs below: parameters of the whole valve first, then parameters of each cusp.
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

void check_values(const ParameterValues &values);
PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening);

// clang-format off
ValveKind make_kind() {
  // The limits suit a valve in any unit from kilometres to micrometres; check_together checks ratios of lengths.
  constexpr double shortest = 1e-9, longest = 1e9;
  const char *length = "length", *degree = "degree", *number = "1";
  ValveKind kind{"aortic", {
    {"root_height", length, "height of the root; does not enter the cusps: the translation does", 1, {1}, 0, longest},
    {"root_radius", length, "radius of the root, where the cusps are attached", 1, {1.29}, shortest, longest},
    {"leaflet_height", length, "height of the free edge above the root", 1, {1.02}, shortest, longest},
    {"bending_height", length, "height of the bending curve above the root", 1, {0.71}, shortest, longest},
    {"t3_leaflet", length, "end tangent of the free edge: right, left, non-coronary", 3, {0.5, 0.5, 0.65}, 0, longest},
    {"t3_bending", length, "end tangent of the bending curve: right, left, non-coronary", 3, {0.55, 0.23, 0.4}, 0, longest},
    {"t0_leaflet", length, "start tangent of the free edge: right, left, non-coronary", 3, {0.025, 0.1, 0.1}, 0, longest},
    {"t0_bending", length, "start tangent of the bending curve: right, left, non-coronary", 3, {0.1, 0.1, 0.1}, 0, longest},
    {"xq", number, "radial place of the symmetry curve's first inner control point", 1, {-0.2}, -10, 10},
    {"zq", number, "vertical place of the symmetry curve's first inner control point", 1, {-0.2}, -10, 10},
    opening_spec("0: this state, to 1: the state to open to (riis_valve_set_open_state), without which it stays 0", 0),
  }, opening, false, check_values, make_patches, nullptr};
  const double table[n_cusps][n_of_cusp] = {
    {0.24, 1.365, 61.0, 1.58,   0.40, 1.390, 47.30, 1.82,      0.0, -1},
    {0.49, 1.495, 58.5, 2.77,   0.74, 1.355, 43.00, 4.12,    119.5, -1},
    {0.20, 1.380, 60.5, 1.19,   0.67, 1.435, 42.75, 2.54,   -121.5, -1}};
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
    const std::string of = std::string(cusp_names[cusp]) + ".";
    const double *value = table[cusp];
    kind.parameters.insert(kind.parameters.end(), {
      {of + "leaflet_radius_in", length, "radius of the free edge at the symmetry plane", 1, {value[leaflet_radius_in]}, 0, longest},
      {of + "leaflet_radius_out", length, "radius of the free edge's end, at the commissure", 1, {value[leaflet_radius_out]}, shortest, longest},
      {of + "leaflet_angle", degree, "angle from the symmetry plane to the free edge's end", 1, {value[leaflet_angle]}, 5, 175},
      {of + "leaflet_power", number, "exponent of the free edge's profile", 1, {value[leaflet_power]}, 1, 20},
      {of + "bending_radius_in", length, "radius of the bending curve at the symmetry plane", 1, {value[bending_radius_in]}, 0, longest},
      {of + "bending_radius_out", length, "radius of the bending curve's end, at the sinus", 1, {value[bending_radius_out]}, shortest, longest},
      {of + "bending_angle", degree, "angle from the symmetry plane to the bending curve's end", 1, {value[bending_angle]}, 5, 175},
      {of + "bending_power", number, "exponent of the bending curve's profile", 1, {value[bending_power]}, 1, 20},
      {of + "rotation", degree, "turns of the cusp about x, then y, then z", 3, {0, 0, value[rotation]}, -360, 360},
      {of + "translation", length, "shift of the cusp after its rotation", 3, {0, 0, value[translation]}, -longest, longest},
    });
  }
  return kind;
}
// clang-format on

std::size_t position_of(std::size_t cusp, OfCusp parameter) { return n_general + cusp * n_of_cusp + parameter; }

// Returns the free edge or the bending curve of half a cusp, y >= 0, in the cusp's frame. It runs from the symmetry
// plane to the end at radius_out and angle, along the profile x(y) = radius_in + (end.x - radius_in) (y / end.y)^power.
Bezier profile_curve(double radius_in, double radius_out, double angle, double power, double height, double t0,
                     double t3) {
  const auto [sine, cosine] = sine_cosine_degrees(angle);
  const Vec3 first{radius_in, 0, height}, last{radius_out * cosine, radius_out * sine, height};
  const double chord_slope = (last.x - radius_in) / last.y;
  const double first_slope = power > 1 ? 0 : chord_slope, last_slope = power * chord_slope;
  return Bezier::cubic(first, first + t0 * Vec3{first_slope, 1, 0}, last - t3 * Vec3{last_slope, 1, 0}, last);
}

// Splits the curve at t and sets the common point to `point`, which is known to be on the curve. Other curves end
// there, to the last bit.
std::pair<Bezier, Bezier> split_through(const Bezier &curve, double t, Vec3 point) {
  auto [below, above] = split(curve, t);
  view(below.control)[below.degree] = point;
  above.control[0] = point;
  return {below, above};
}

// The curves of half a cusp in the cusp's frame. Its symmetry plane is y = 0, the root is at z = 0, and z points to the aorta.
struct HalfCusp {
  Bezier leaflet, bending, sinus_below, sinus_above, symmetry_below, symmetry_above;
};

HalfCusp half_cusp(const ParameterValues &values, std::size_t cusp) {
  const auto general = [&](General parameter, std::size_t i = 0) { return values[parameter][i]; };
  const auto own = [&](OfCusp parameter) { return values[position_of(cusp, parameter)][0]; };
  const double R = general(root_radius), h_l = general(leaflet_height), h_b = general(bending_height), s = h_b / h_l;

  HalfCusp half;
  half.leaflet = profile_curve(own(leaflet_radius_in), own(leaflet_radius_out), own(leaflet_angle), own(leaflet_power),
                               h_l, general(t0_leaflet, cusp), general(t3_leaflet, cusp));
  half.bending = profile_curve(own(bending_radius_in), own(bending_radius_out), own(bending_angle), own(bending_power),
                               h_b, general(t0_bending, cusp), general(t3_bending, cusp));

  // The sinus curve is the quadratic from the root point to the leaflet's end, through the bending curve's end at s.
  const Vec3 root{R, 0, 0}, L = half.leaflet.last(), B = half.bending.last();
  const Vec3 through = (1.0 / (2 * s * (1 - s))) * (B - (1 - s) * (1 - s) * root - s * s * L);
  std::tie(half.sinus_below, half.sinus_above) = split_through(Bezier::quadratic(root, through, L), s, B);

  // The symmetry curve is the cubic from the root point to the leaflet's middle, through the bending curve's middle at s.
  const Vec3 b = half.bending.first(), D3 = half.leaflet.first();
  const Vec3 D1{0.5 * (R + b.x) + general(xq) * (R - b.x), 0, 0.5 * h_b + general(zq) * h_b};
  const double a = 1 - s;
  const Vec3 D2 = (1.0 / (3 * a * s * s)) * (b - a * a * a * root - 3 * a * a * s * D1 - s * s * s * D3);
  std::tie(half.symmetry_below, half.symmetry_above) = split_through(Bezier::cubic(root, D1, D2, D3), s, b);
  return half;
}

// Checks lengths against the root radius, and heights against each other.
void check_together(const ParameterValues &values) {
  const Measure radius{"root_radius", values[root_radius][0]}, height{"leaflet_height", values[leaflet_height][0]};
  const auto check = [&](std::size_t position, const Measure &measure, double least, double most) {
    check_ratio(aortic_valve_kind().parameters[position], values[position], measure, least, most);
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

// Refuses a curve that reaches far away, and names the parameters that made it. Values that are sound one by one can do
// that: a high power with a long tangent, or a bending curve near the root.
void check_reach(const Bezier &curve, const char *what, const char *parameters, std::size_t cusp, double size) {
  for (int i = 0; i <= curve.degree; ++i) {
    const double reach = length(view(curve.control)[i]);
    if (!(reach <= 5 * size))
      fail(RIIS_INVALID_PARAMETER, "the ", cusp_names[cusp], " cusp's ", what, " curve reaches ", reach,
           " from the root's middle, more than 5 times ", size,
           ", the larger of root_radius and leaflet_height: look at ", parameters);
  }
}

// Checks every curve of one state. Curves between two checked states lie between theirs.
void check_values(const ParameterValues &values) {
  check_together(values);
  const double size = std::max(values[root_radius][0], values[leaflet_height][0]);
  const char *of_symmetry = "bending_height, leaflet_height, xq, zq, *_radius_in";
  const char *of_sinus = "bending_height, leaflet_height, *_radius_out, *_angle";
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
    const HalfCusp half = half_cusp(values, cusp);
    check_reach(half.leaflet, "leaflet", "leaflet_power, leaflet_angle, t0_leaflet, t3_leaflet, leaflet_radius_*", cusp,
                size);
    check_reach(half.bending, "bending", "bending_power, bending_angle, t0_bending, t3_bending, bending_radius_*", cusp,
                size);
    for (const Bezier *curve : {&half.symmetry_below, &half.symmetry_above})
      check_reach(*curve, "symmetry", of_symmetry, cusp, size);
    for (const Bezier *curve : {&half.sinus_below, &half.sinus_above})
      check_reach(*curve, "sinus", of_sinus, cusp, size);
  }
}

PatchSet make_patches(const ValveState &closed, const ValveState &open, double opening) {
  PatchSet set;
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
    const HalfCusp half = half_cusp(closed.values, cusp), open_half = half_cusp(open.values, cusp);
    const auto add = [&](const Curve &curve) {
      set.curves.push_back(curve);
      return Side{set.curves.size() - 1};
    };
    const auto add_blended = [&](Bezier HalfCusp::*curve) {
      return add(blend(half.*curve, open_half.*curve, opening));
    };
    const Side root = add(Bezier::point(blend(half.symmetry_below.first(), open_half.symmetry_below.first(), opening)));
    const Side symmetry_below = add_blended(&HalfCusp::symmetry_below);
    const Side symmetry_above = add_blended(&HalfCusp::symmetry_above);
    const Side bending = add_blended(&HalfCusp::bending), leaflet = add_blended(&HalfCusp::leaflet);
    const Side sinus_below = add_blended(&HalfCusp::sinus_below), sinus_above = add_blended(&HalfCusp::sinus_above);

    // The frame has no control points: its angles and its shift are blended as numbers.
    const auto vector_of = [&](OfCusp parameter) {
      const auto &from = closed.values[position_of(cusp, parameter)], &to = open.values[position_of(cusp, parameter)];
      return blend(Vec3{from[0], from[1], from[2]}, Vec3{to[0], to[1], to[2]}, opening);
    };
    const Rotation turn = rotation_xyz(vector_of(rotation));
    const Vec3 shift = vector_of(translation);
    const auto images = [&](std::int32_t part) {
      const auto leaflet_id = static_cast<std::int32_t>(cusp);
      return Vector<PatchImage>{{Mirror::none, turn, shift, leaflet_id, 4 * leaflet_id + part},
                                     {Mirror::in_y, turn, shift, leaflet_id, 4 * leaflet_id + part + 2}};
    };
    // u runs from the symmetry plane to the sinus, and v runs upwards. So S_u x S_v points to the sinus face: downstream.
    set.patches.push_back({root, bending, symmetry_below, sinus_below, images(0)});
    set.patches.push_back({bending, leaflet, symmetry_above, sinus_above, images(1)});
  }
  return set;
}

}  // namespace

const ValveKind &aortic_valve_kind() {
  // The kind is made at the first use and never destroyed, so it is usable from the first to the last instruction of
  // the process.
  static const ValveKind &kind = *new ValveKind(make_kind());
  return kind;
}

}  // namespace riis
