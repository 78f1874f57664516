// SPDX-License-Identifier: Apache-2.0
#include "valve/aortic.hpp"

#include <cmath>
#include <tuple>

#include "api/errors.hpp"
#include "geometry/placement.hpp"
#include "valve/patches.hpp"

namespace riis {
namespace {

// Positions in the list of specs below: those of the whole valve, then those of each cusp.
enum General {
  root_height,
  root_radius,
  leaflet_height,
  bending_height,
  t3_leaflet,
  t3_bending,
  t0_leaflet,
  t0_bending,
  xq,
  zq,
  n_general
};
enum OfCusp {
  leaflet_radius_in,
  leaflet_radius_out,
  leaflet_angle,
  leaflet_power,
  bending_radius_in,
  bending_radius_out,
  bending_angle,
  bending_power,
  rotation,
  translation,
  n_of_cusp
};
constexpr std::size_t n_cusps = 3;

// Ranges that keep every length between what a valve can be in micrometres and in kilometres; absurd ratios are refused
// when the patches are made.
constexpr double shortest = 1e-9, longest = 1e9;

#define RIIS_CUSP(cusp, r_li, r_lo, a_l, p_l, r_bi, r_bo, a_b, p_b, turn)                                                \
  {cusp ".leaflet_radius_in", "length", "radius of the free edge at the symmetry plane", 1, {r_li}, 0, longest},         \
      {cusp ".leaflet_radius_out",                                                                                       \
       "length",                                                                                                         \
       "radius of the end of the free edge, at the commissure",                                                          \
       1,                                                                                                                \
       {r_lo},                                                                                                           \
       shortest,                                                                                                         \
       longest},                                                                                                         \
      {cusp ".leaflet_angle", "degree", "angle from the symmetry plane to the end of the free edge", 1, {a_l}, 1, 179},  \
      {cusp ".leaflet_power", "1", "exponent of the free edge's profile", 1, {p_l}, 1, 100},                             \
      {cusp ".bending_radius_in", "length", "radius of the bending curve at the symmetry plane", 1, {r_bi}, 0, longest}, \
      {cusp ".bending_radius_out",                                                                                       \
       "length",                                                                                                         \
       "radius of the end of the bending curve, at the sinus",                                                           \
       1,                                                                                                                \
       {r_bo},                                                                                                           \
       shortest,                                                                                                         \
       longest},                                                                                                         \
      {cusp ".bending_angle",                                                                                            \
       "degree",                                                                                                         \
       "angle from the symmetry plane to the end of the bending curve",                                                  \
       1,                                                                                                                \
       {a_b},                                                                                                            \
       1,                                                                                                                \
       179},                                                                                                             \
      {cusp ".bending_power", "1", "exponent of the bending curve's profile", 1, {p_b}, 1, 100},                         \
      {cusp ".rotation", "degree", "turns of the cusp about x, then y, then z", 3, {0, 0, turn}, -360, 360}, {           \
    cusp ".translation", "length", "shift of the cusp after its rotation", 3, {0, 0, -1}, -longest, longest              \
  }

PatchSet make_patches(const ParameterValues &values);

const ValveKind kind = {
    "aortic",
    {{"root_height",
      "length",
      "height of the root; does not enter the cusps: the translation does",
      1,
      {1},
      0,
      longest},
     {"root_radius", "length", "radius of the root, where the cusps are attached", 1, {1.29}, shortest, longest},
     {"leaflet_height", "length", "height of the free edge above the root", 1, {1.02}, shortest, longest},
     {"bending_height", "length", "height of the bending curve above the root", 1, {0.71}, shortest, longest},
     {"t3_leaflet",
      "length",
      "end tangent of the free edge: right, left, non-coronary",
      3,
      {0.5, 0.5, 0.65},
      0,
      longest},
     {"t3_bending",
      "length",
      "end tangent of the bending curve: right, left, non-coronary",
      3,
      {0.55, 0.23, 0.4},
      0,
      longest},
     {"t0_leaflet",
      "length",
      "start tangent of the free edge: right, left, non-coronary",
      3,
      {0.025, 0.1, 0.1},
      0,
      longest},
     {"t0_bending",
      "length",
      "start tangent of the bending curve: right, left, non-coronary",
      3,
      {0.1, 0.1, 0.1},
      0,
      longest},
     {"xq", "1", "radial place of the symmetry curve's first inner control point", 1, {-0.2}, -10, 10},
     {"zq", "1", "vertical place of the symmetry curve's first inner control point", 1, {-0.2}, -10, 10},
     RIIS_CUSP("right", 0.24, 1.365, 61, 1.58, 0.4, 1.39, 47.3, 1.82, 0),
     RIIS_CUSP("left", 0.49, 1.495, 58.5, 2.77, 0.74, 1.355, 43, 4.12, 119.5),
     RIIS_CUSP("non_coronary", 0.2, 1.38, 60.5, 1.19, 0.67, 1.435, 42.75, 2.54, -121.5)},
    make_patches};
#undef RIIS_CUSP

const char *name_of(std::size_t cusp, OfCusp parameter) {
  return kind.parameters[n_general + cusp * n_of_cusp + parameter].name;
}

// The free edge or the bending curve of half a cusp, y >= 0, in the cusp's frame: from the symmetry plane to the end at
// radius_out and angle, along the profile x(y) = radius_in + (end.x - radius_in) (y / end.y)^power.
Bezier profile_curve(double radius_in, double radius_out, double angle, double power, double height, double t0,
                     double t3) {
  const auto [sine, cosine] = sine_cosine_degrees(angle);
  const Vec3 first{radius_in, 0, height}, last{radius_out * cosine, radius_out * sine, height};
  const double chord_slope = (last.x - radius_in) / last.y;
  const double first_slope = power > 1 ? 0 : chord_slope, last_slope = power * chord_slope;
  return Bezier::cubic(first, first + t0 * Vec3{first_slope, 1, 0}, last - t3 * Vec3{last_slope, 1, 0}, last);
}

// Splits at t and sets the common point, known to be on the curve, to the last bit: other curves end in it.
std::pair<Bezier, Bezier> split_through(const Bezier &curve, double t, Vec3 point) {
  auto [below, above] = split(curve, t);
  below.control[static_cast<std::size_t>(below.degree)] = point;
  above.control[0] = point;
  return {below, above};
}

// The curves of half a cusp in the cusp's frame: symmetry plane y = 0, root at z = 0, z to the aorta.
struct HalfCusp {
  Bezier leaflet, bending, sinus_below, sinus_above, symmetry_below, symmetry_above;
};

HalfCusp half_cusp(const ParameterValues &values, std::size_t cusp) {
  const auto general = [&](General parameter, std::size_t i = 0) { return values[parameter][i]; };
  const auto own = [&](OfCusp parameter) { return values[n_general + cusp * n_of_cusp + parameter][0]; };
  const double R = general(root_radius), h_l = general(leaflet_height), h_b = general(bending_height), s = h_b / h_l;

  HalfCusp half;
  half.leaflet = profile_curve(own(leaflet_radius_in), own(leaflet_radius_out), own(leaflet_angle), own(leaflet_power),
                               h_l, general(t0_leaflet, cusp), general(t3_leaflet, cusp));
  half.bending = profile_curve(own(bending_radius_in), own(bending_radius_out), own(bending_angle), own(bending_power),
                               h_b, general(t0_bending, cusp), general(t3_bending, cusp));

  // Sinus: the quadratic from the root point to the leaflet's end, through the bending curve's end at s.
  const Vec3 root{R, 0, 0}, L = half.leaflet.last(), B = half.bending.last();
  const Vec3 through = (1.0 / (2 * s * (1 - s))) * (B - (1 - s) * (1 - s) * root - s * s * L);
  std::tie(half.sinus_below, half.sinus_above) = split_through(Bezier::quadratic(root, through, L), s, B);

  // Symmetry: the cubic from the root point to the leaflet's middle, through the bending curve's middle at s.
  const Vec3 b = half.bending.first(), D3 = half.leaflet.first();
  const Vec3 D1{0.5 * (R + b.x) + general(xq) * (R - b.x), 0, 0.5 * h_b + general(zq) * h_b};
  const double a = 1 - s;
  const Vec3 D2 = (1.0 / (3 * a * s * s)) * (b - a * a * a * root - 3 * a * a * s * D1 - s * s * s * D3);
  std::tie(half.symmetry_below, half.symmetry_above) = split_through(Bezier::cubic(root, D1, D2, D3), s, b);
  return half;
}

void check_together(const ParameterValues &values) {
  const double R = values[root_radius][0], h_l = values[leaflet_height][0], h_b = values[bending_height][0];
  if (!(h_b <= 0.99 * h_l && h_b >= 0.01 * h_l))
    fail(RIIS_INVALID_PARAMETER, "bending_height is %g; it must be from 0.01 to 0.99 of leaflet_height, which is %g",
         h_b, h_l);
  const auto check_ratio = [R](const char *name, double value) {
    if (value > 100 * R)
      fail(RIIS_INVALID_PARAMETER, "%s is %g; it must be at most 100 times root_radius, which is %g", name, value, R);
  };
  check_ratio("leaflet_height", h_l);
  for (const General parameter : {t3_leaflet, t3_bending, t0_leaflet, t0_bending})
    for (const double value : values[parameter]) check_ratio(kind.parameters[parameter].name, value);
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp)
    for (const OfCusp parameter : {leaflet_radius_in, leaflet_radius_out, bending_radius_in, bending_radius_out})
      check_ratio(name_of(cusp, parameter), values[n_general + cusp * n_of_cusp + parameter][0]);
  // The other way round: a root that is huge for its leaflets collapses them to rounding.
  if (h_l < 0.01 * R)
    fail(RIIS_INVALID_PARAMETER, "leaflet_height is %g; it must be at least 0.01 of root_radius, which is %g", h_l, R);
}

PatchSet make_patches(const ParameterValues &values) {
  check_together(values);
  PatchSet set;
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
    const auto vector_of = [&](OfCusp parameter) {
      const auto &value = values[n_general + cusp * n_of_cusp + parameter];
      return Vec3{value[0], value[1], value[2]};
    };
    const Rotation turn = rotation_xyz(vector_of(rotation));
    const Vec3 shift = vector_of(translation);
    const HalfCusp half = half_cusp(values, cusp);
    const auto add = [&](Bezier curve, double mirror) {
      for (Vec3 &q : curve.control) q = turn * Vec3{q.x, mirror * q.y, q.z} + shift;
      set.curves.push_back(curve);
      return set.curves.size() - 1;
    };
    // The mirrored half shares the curves of the symmetry plane and the root point.
    const std::size_t root = add(Bezier::point(half.symmetry_below.first()), 1);
    const std::size_t symmetry_below = add(half.symmetry_below, 1), symmetry_above = add(half.symmetry_above, 1);
    const auto leaflet_id = static_cast<std::int32_t>(cusp);
    for (const bool mirrored : {false, true}) {
      const double mirror = mirrored ? -1 : 1;
      const std::size_t bending = add(half.bending, mirror), leaflet = add(half.leaflet, mirror);
      const std::size_t sinus_below = add(half.sinus_below, mirror), sinus_above = add(half.sinus_above, mirror);
      const std::int32_t patch_id = 4 * leaflet_id + (mirrored ? 2 : 0);
      // u runs from the symmetry plane to the sinus and v upwards, so S_u x S_v points to the sinus face: downstream.
      set.patches.push_back({root, bending, symmetry_below, sinus_below, leaflet_id, patch_id, mirrored});
      set.patches.push_back({bending, leaflet, symmetry_above, sinus_above, leaflet_id, patch_id + 1, mirrored});
    }
  }
  return set;
}

}  // namespace

const ValveKind &aortic_valve_kind() { return kind; }

}  // namespace riis
