// SPDX-License-Identifier: Apache-2.0
#include "valve/cusp.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "geometry/placement.hpp"

namespace riis {
namespace {

Vec3 end_of(const CuspProfile &profile, double height) {
  const auto [sine, cosine] = sine_cosine_degrees(profile.angle);
  return {profile.radius_out * cosine, profile.radius_out * sine, height};
}

// Returns the profile's curve for y >= 0 in the cusp's frame.
Bezier profile_curve(const CuspProfile &profile, double height) {
  const Vec3 first{profile.radius_in, 0, height}, last = end_of(profile, height);
  const double chord_slope = (last.x - profile.radius_in) / last.y;
  const double first_slope = profile.power > 1 ? 0 : chord_slope, last_slope = profile.power * chord_slope;
  return Bezier::cubic(first, first + profile.t0 * Vec3{first_slope, 1, 0}, last - profile.t3 * Vec3{last_slope, 1, 0},
                       last);
}

// Splits the curve at t. Replaces the common point by `point`, which must be on the curve except for rounding. So the common
// point has the bits of the ends of other curves there.
std::pair<Bezier, Bezier> split_through(const Bezier &curve, double t, Vec3 point) {
  auto [below, above] = split(curve, t);
  view(below.control)[below.degree] = point;
  above.control[0] = point;
  return {below, above};
}

// For the power 2, the cubic is exactly the profile if its end tangents have a third of the end's y as their length.
CuspProfile parabola(double radius_in, double radius_out, double angle) {
  const double third = radius_out * sine_cosine_degrees(angle).sine / 3;
  return {radius_in, radius_out, angle, 2, third, third};
}

template <class Make>
HalfCusp of_each(const Make &make) {
  return {make(&HalfCusp::leaflet),     make(&HalfCusp::bending),        make(&HalfCusp::sinus_below),
          make(&HalfCusp::sinus_above), make(&HalfCusp::symmetry_below), make(&HalfCusp::symmetry_above)};
}

}  // namespace

std::array<ParameterSpec, 2> cusp_opening_specs(const CuspOpening &defaults) {
  return {{{"open_radius_ratio",
            "1",
            "open state: radius of the free edge at the symmetry plane, times root_radius",
            1,
            {defaults.radius_ratio},
            0.05,
            1.5},
           {"commissure_expansion",
            "1",
            "open state: how far the commissures move outwards, times leaflet_radius_out",
            1,
            {defaults.expansion},
            0,
            0.5}}};
}

CuspShape open_shape(const CuspShape &closed, const CuspOpening &opening) {
  CuspShape open = closed;
  const double s = closed.bending_height / closed.leaflet_height, R = closed.root_radius;
  const double radius_in = opening.radius_ratio * R;
  open.leaflet = parabola(radius_in, (1 + opening.expansion) * closed.leaflet.radius_out, closed.leaflet.angle);
  open.bending =
      parabola(R + s * (radius_in - R), (1 + s * opening.expansion) * closed.bending.radius_out, closed.bending.angle);
  return open;
}

HalfCusp half_cusp(const CuspShape &shape) {
  const double R = shape.root_radius, h_l = shape.leaflet_height, h_b = shape.bending_height, s = h_b / h_l;
  HalfCusp half;
  half.leaflet = profile_curve(shape.leaflet, h_l);
  half.bending = profile_curve(shape.bending, h_b);

  // The sinus curve is a quadratic. It runs from the root point to the leaflet's end, and passes through the bending curve's end
  // at s.
  const Vec3 root{R, 0, 0}, L = half.leaflet.last(), B = half.bending.last();
  const Vec3 through = (1.0 / (2 * s * (1 - s))) * (B - (1 - s) * (1 - s) * root - s * s * L);
  std::tie(half.sinus_below, half.sinus_above) = split_through(Bezier::quadratic(root, through, L), s, B);

  // The symmetry curve is a cubic. It runs from the root point to the leaflet's middle, and passes through the bending curve's
  // middle at s.
  const Vec3 b = half.bending.first(), D3 = half.leaflet.first();
  const Vec3 D1{0.5 * (R + b.x) + shape.xq * (R - b.x), 0, 0.5 * h_b + shape.zq * h_b};
  const double a = 1 - s;
  const Vec3 D2 = (1.0 / (3 * a * s * s)) * (b - a * a * a * root - 3 * a * a * s * D1 - s * s * s * D3);
  std::tie(half.symmetry_below, half.symmetry_above) = split_through(Bezier::cubic(root, D1, D2, D3), s, b);
  return half;
}

HalfCusp blend(const HalfCusp &closed, const HalfCusp &open, double opening) {
  return of_each([&](Bezier HalfCusp::*curve) { return blend(closed.*curve, open.*curve, opening); });
}

HalfCusp rate(const HalfCusp &closed, const HalfCusp &open) {
  return of_each([&](Bezier HalfCusp::*curve) { return rate(closed.*curve, open.*curve); });
}

void check_reach(const HalfCusp &half, const CuspShape &shape, const char *state, const char *cusp, const char *also) {
  const double size = std::max(shape.root_radius, shape.leaflet_height);
  const auto check = [&](const Bezier &curve, const char *what, const char *parameters) {
    for (int i = 0; i <= curve.degree; ++i) {
      const double reach = length(view(curve.control)[i]);
      if (!(reach <= 5 * size))
        fail(RIIS_INVALID_PARAMETER, state, cusp, "'s ", what, " curve reaches ", reach,
             " from the root's middle, more than 5 times ", size,
             ", the larger of root_radius and leaflet_height: look at ", parameters, also);
    }
  };
  const char *of_symmetry = "bending_height, leaflet_height, xq, zq, *_radius_in";
  const char *of_sinus = "bending_height, leaflet_height, *_radius_out, *_angle";
  check(half.leaflet, "leaflet", "leaflet_power, leaflet_angle, t0_leaflet, t3_leaflet, leaflet_radius_*");
  check(half.bending, "bending", "bending_power, bending_angle, t0_bending, t3_bending, bending_radius_*");
  check(half.symmetry_below, "symmetry", of_symmetry);
  check(half.symmetry_above, "symmetry", of_symmetry);
  check(half.sinus_below, "sinus", of_sinus);
  check(half.sinus_above, "sinus", of_sinus);
}

void add_cusps(PatchSet &set, const HalfCusp &half, const HalfCusp &rate, const Vector<CuspPlace> &places) {
  const auto add = [&](const Bezier &curve, const Bezier &its_rate) {
    set.rates.push_back({its_rate});
    return set.add(curve);
  };
  const auto add_one = [&](Bezier HalfCusp::*curve) { return add(half.*curve, rate.*curve); };
  const Side root = add(Bezier::point(half.symmetry_below.first()), Bezier::point(rate.symmetry_below.first()));
  const Side symmetry_below = add_one(&HalfCusp::symmetry_below), symmetry_above = add_one(&HalfCusp::symmetry_above);
  const Side bending = add_one(&HalfCusp::bending), leaflet = add_one(&HalfCusp::leaflet);
  const Side sinus_below = add_one(&HalfCusp::sinus_below), sinus_above = add_one(&HalfCusp::sinus_above);
  const auto images = [&](std::int32_t part) {
    Vector<PatchImage> made;
    for (const auto &[turn, shift, leaflet_id] : places) {
      made.push_back({Mirror::none, turn, shift, leaflet_id, 4 * leaflet_id + part});
      made.push_back({Mirror::in_y, turn, shift, leaflet_id, 4 * leaflet_id + part + 2});
    }
    return made;
  };
  // u runs from the symmetry plane to the sinus, and v runs upwards. So S_u x S_v points to the sinus face, downstream.
  set.patches.push_back({root, bending, symmetry_below, sinus_below, images(0), 0, AttachedSide::u1});
  set.patches.push_back({bending, leaflet, symmetry_above, sinus_above, images(1), 0, AttachedSide::u1});
}

Vector<CuspPlace> equal_places(Vec3 shift) {
  // The cusps follow each other round the axis in this order.
  constexpr double turns[3] = {0, 120, -120};
  Vector<CuspPlace> places;
  for (std::int32_t cusp = 0; cusp < 3; ++cusp)
    // Adds 0, which turns -0 into 0, so that the cusps have the same bits where they meet on the axis.
    places.push_back({rotation_xyz({0, 0, view(turns)[cusp]}), shift + Vec3{0, 0, 0}, cusp});
  return places;
}

void sew_equal_cusps(PatchSet &set, std::size_t patch, SeamPlace place) {
  constexpr std::size_t right = 0, left = 1, non_coronary = 2;
  for (const auto &[cusp, before] :
       {std::pair(right, non_coronary), std::pair(left, right), std::pair(non_coronary, left)})
    set.seams.push_back({patch, 2 * cusp + 1, 2 * before, place});
}

}  // namespace riis
