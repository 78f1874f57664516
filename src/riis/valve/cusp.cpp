// SPDX-License-Identifier: Apache-2.0
#include "valve/cusp.hpp"

#include <algorithm>
#include <optional>
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

// Splits the curve at t. The common end of both parts becomes `point`, which must be on the curve up to rounding. Other curves
// that end at `point` thus meet both parts to the last bit.
std::pair<Bezier, Bezier> split_through(const Bezier &curve, double t, Vec3 point) {
  auto [below, above] = split(curve, t);
  view(below.control)[below.degree] = point;
  above.control[0] = point;
  return {below, above};
}

// For the power 2, a cubic equals the profile exactly if the length of its end tangents is a third of the end's y.
CuspProfile parabola(double radius_in, double radius_out, double angle) {
  const double third = radius_out * sine_cosine_degrees(angle).sine / 3;
  return {radius_in, radius_out, angle, 2, third, third};
}

template <class Make>
HalfCusp of_each(const Make &make) {
  return {make(&HalfCusp::leaflet),     make(&HalfCusp::bending),        make(&HalfCusp::sinus_below),
          make(&HalfCusp::sinus_above), make(&HalfCusp::symmetry_below), make(&HalfCusp::symmetry_above)};
}

Side add(PatchSet &set, const Bezier &curve, const Bezier &rate) {
  set.rates.push_back({rate});
  return set.add(curve);
}

Side add_sinus_below(PatchSet &set, const HalfCusp &part, const HalfCusp &rate) {
  if (!part.sinus_start) return add(set, part.sinus_below, rate.sinus_below);
  set.rates.push_back({*rate.sinus_start, rate.sinus_below});
  return set.add(Curve({*part.sinus_start, part.sinus_below}));
}

// The sides at which the two halves of a cusp meet.
struct SymmetrySides {
  Side root, below, above;
};

SymmetrySides add_middle(PatchSet &set, const MovingHalf &half) {
  const HalfCusp &part = half.parts.front(), &rate = half.rates.front();
  return {add(set, Bezier::point(part.symmetry_below.first()), Bezier::point(rate.symmetry_below.first())),
          add(set, part.symmetry_below, rate.symmetry_below), add(set, part.symmetry_above, rate.symmetry_above)};
}

// Adds the patches of all parts. The first part begins at `middle`. The last part ends at `commissure`, or at its own side.
// images(0, number) makes the images of a part's lower patch, and images(1, number) those of the upper patch.
template <class Images>
void add_parts(PatchSet &set, const MovingHalf &half, const SymmetrySides &middle,
               const std::optional<Side> &commissure, const Images &images) {
  Side inner_below = middle.below, inner_above = middle.above;
  for (std::size_t i = 0; i < half.parts.size(); ++i) {
    const auto add_one = [&](Bezier HalfCusp::*curve) { return add(set, half.parts[i].*curve, half.rates[i].*curve); };
    const Side bending = add_one(&HalfCusp::bending), leaflet = add_one(&HalfCusp::leaflet);
    const bool is_last = i + 1 == half.parts.size();
    const Side below = add_sinus_below(set, half.parts[i], half.rates[i]);
    const Side above = is_last && commissure ? *commissure : add_one(&HalfCusp::sinus_above);
    const AttachedSide attached = is_last ? AttachedSide::u1 : AttachedSide::none;
    const auto number = static_cast<std::int32_t>(i);
    // u runs from the symmetry plane to the sinus, and v runs upwards. S_u x S_v therefore points to the sinus face, downstream.
    set.patches.push_back({middle.root, bending, inner_below, below, images(0, number), 0, attached});
    set.patches.push_back({bending, leaflet, inner_above, above, images(1, number), 0, attached});
    inner_below = below, inner_above = above;
  }
}

// Returns the half after it is mirrored, turned and moved as the image is.
MovingHalf turned(const MovingHalf &half, const PatchImage &image) {
  const auto turn = [&](Bezier curve) {
    for (int i = 0; i <= curve.degree; ++i) view(curve.control)[i] = place(image, view(curve.control)[i]);
    return curve;
  };
  const auto turn_all = [&](const Vector<HalfCusp> &parts) {
    Vector<HalfCusp> made;
    for (const HalfCusp &part : parts) {
      made.push_back(of_each([&](Bezier HalfCusp::*curve) { return turn(part.*curve); }));
      if (part.sinus_start) made.back().sinus_start = turn(*part.sinus_start);
    }
    return made;
  };
  return {turn_all(half.parts), turn_all(half.rates)};
}

// Makes a half begin at the same point as the other half, in the middle of the cusp. The two middles differ only by rounding.
void begin_at(HalfCusp &half, const HalfCusp &other) {
  half.leaflet.control[0] = other.leaflet.first();
  half.bending.control[0] = other.bending.first();
}

// Moves the ends of the curves at the commissure to this point. The ends differ from this point only by rounding.
void end_at(HalfCusp &half, Vec3 commissure) {
  for (Bezier HalfCusp::*curve : {&HalfCusp::leaflet, &HalfCusp::bending, &HalfCusp::sinus_below})
    view((half.*curve).control)[(half.*curve).degree] = commissure;
}

}  // namespace

std::array<ParameterSpec, 2> cusp_opening_specs(const CuspOpening &defaults) {
  return {{{"open_radius_ratio",
            "1",
            "radius of the open free edge at the symmetry plane, as a multiple of root_radius",
            1,
            {defaults.radius_ratio},
            0.05,
            1.5},
           {"commissure_expansion",
            "1",
            "how far the commissures move outwards during opening, as a multiple of leaflet_radius_out",
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

  // The sinus curve is a quadratic from the root point to the leaflet's end, and passes through the bending curve's end at s.
  const Vec3 root{R, 0, 0}, L = half.leaflet.last(), B = half.bending.last();
  const Vec3 through = (1.0 / (2 * s * (1 - s))) * (B - (1 - s) * (1 - s) * root - s * s * L);
  std::tie(half.sinus_below, half.sinus_above) = split_through(Bezier::quadratic(root, through, L), s, B);

  // The symmetry curve is a cubic from the root point to the leaflet's middle, and passes through the bending curve's middle at
  // s.
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

HalfCusp rate(const HalfCusp &closed, const HalfCusp &open, double apart) {
  const auto of_curve = [&](const Bezier &from, const Bezier &to) {
    Bezier made = rate(from, to);
    for (Vec3 &q : made.control) q = (1 / apart) * q;
    return made;
  };
  HalfCusp made = of_each([&](Bezier HalfCusp::*curve) { return of_curve(closed.*curve, open.*curve); });
  if (closed.sinus_start) made.sinus_start = of_curve(*closed.sinus_start, *open.sinus_start);
  return made;
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

void add_cusps(PatchSet &set, const MovingHalf &half, const Vector<CuspPlace> &places) {
  const SymmetrySides middle = add_middle(set, half);
  add_parts(set, half, middle, std::nullopt, [&](std::int32_t part, std::int32_t first_id) {
    Vector<PatchImage> made;
    for (const auto &[turn, shift, leaflet_id] : places) {
      const std::int32_t id = 4 * (first_id * static_cast<std::int32_t>(places.size()) + leaflet_id) + part;
      made.push_back({Mirror::none, turn, shift, leaflet_id, id});
      made.push_back({Mirror::in_y, turn, shift, leaflet_id, id + 2});
    }
    return made;
  });
}

Vector<CuspPlace> equal_places(std::size_t n_cusps, Vec3 shift) {
  Vector<CuspPlace> places;
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp) {
    const double turn = 360.0 / static_cast<double>(n_cusps) * static_cast<double>(cusp);
    // Adding 0 turns -0 into 0, so that the cusps have the same bits where they meet on the axis.
    places.push_back(
        {rotation_xyz({0, 0, turn > 180 ? turn - 360 : turn}), shift + Vec3{0, 0, 0}, static_cast<std::int32_t>(cusp)});
  }
  return places;
}

void sew_equal_cusps(PatchSet &set, std::size_t patch, SeamPlace place) {
  const std::size_t n_cusps = set.patches[patch].images.size() / 2;
  for (std::size_t cusp = 0; cusp < n_cusps; ++cusp)
    set.seams.push_back({patch, 2 * cusp + 1, 2 * ((cusp + n_cusps - 1) % n_cusps), place});
}

void add_unequal_cusps(PatchSet &set, const Vector<UnequalCusp> &cusps, Vec3 shift) {
  const std::size_t n_cusps = cusps.size();
  Vector<std::array<MovingHalf, 2>> placed;
  for (const UnequalCusp &cusp : cusps) {
    const Rotation turn = rotation_xyz({0, 0, cusp.turn_degrees});
    placed.push_back({turned(cusp.halves[0], {Mirror::none, turn, {0, 0, 0}, 0, 0}),
                      turned(cusp.halves[1], {Mirror::in_y, turn, {0, 0, 0}, 0, 0})});
  }
  // Two curves meet at a commissure, but each is turned with its own rounding. One of the curves therefore takes its end from the
  // other.
  Vector<Side> commissures;
  for (std::size_t k = 0; k < n_cusps; ++k) {
    const auto &[here, there] = placed[k];
    begin_at(placed[k][1].parts.front(), here.parts.front());
    end_at(placed[(k + 1) % n_cusps][1].parts.back(), here.parts.back().leaflet.last());
    commissures.push_back(add(set, here.parts.back().sinus_above, here.rates.back().sinus_above));
  }
  for (std::size_t k = 0; k < n_cusps; ++k) {
    const SymmetrySides middle = add_middle(set, placed[k][0]);
    for (std::size_t side = 0; side < 2; ++side) {
      const Side commissure = commissures[side == 0 ? k : (k + n_cusps - 1) % n_cusps];
      add_parts(set, view(placed[k])[side], middle, commissure, [&](std::int32_t part, std::int32_t first_id) {
        const auto leaflet_id = static_cast<std::int32_t>(k), n = static_cast<std::int32_t>(n_cusps);
        const std::int32_t id = 4 * (first_id * n + leaflet_id) + part + (side == 0 ? 0 : 2);
        return Vector<PatchImage>{{Mirror::none, no_rotation, shift, leaflet_id, id, side == 1}};
      });
    }
  }
}

}  // namespace riis
