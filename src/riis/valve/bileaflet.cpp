// SPDX-License-Identifier: Apache-2.0
// The bileaflet mechanical valve. Two rigid flat leaflets in a round housing turn about their hinges (docs/theory/bileaflet.md).
// This file makes the patches of the two leaflets from the parameters of two states and the opening. If ring_height is not 0, it
// also makes the patches of the housing's wall.
#include <riis/riis.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.hpp"
#include "common/elementary.hpp"
#include "geometry/placement.hpp"
#include "valve/patches.hpp"
#include "valve/valve.hpp"

namespace riis {
namespace {

// The positions in the list of specs below.
enum Parameter { radius, hinge_offset, hinge_height, gap, closed_angle, open_angle, ring_height, opening };

void check_values(const ParameterValues &values);
void check_states(const ValveState &valve, const ValveState &other, const char *name);
PatchSet make_patches(const ValveState &closed, const ValveState &open, double at);

// clang-format off
ValveKind make_kind() {
  // The limits of lengths allow a valve in any unit from kilometres to micrometres. The ratios of lengths are checked by
  // check_values.
  constexpr double shortest = 1e-9, longest = 1e9;
  const char *length = "length", *degree = "degree";
  ValveKind kind{"bileaflet", {
    {"radius", length, "inner radius of the housing, which the closed leaflets reach", 1, {1.1}, shortest, longest,
     {}, {"annulus", 2}},
    {"hinge_offset", length, "distance of each hinge line from the housing's axis", 1, {0.22}, 0, longest},
    {"hinge_height", length, "height of the hinge lines above the orifice plane", 1, {0}, -longest, longest},
    {"gap", length, "width of the slit between the closed leaflets", 1, {0}, 0, longest},
    {"closed_angle", degree, "angle of the closed leaflets from the orifice plane", 1, {30}, 0, 80},
    {"open_angle", degree, "angle of the open leaflets from the orifice plane", 1, {85}, 0, 90},
    {"ring_height", length, "height of the housing's wall, half of it above the orifice plane; 0 means no wall",
     1, {0}, 0, longest},
    opening_spec("from 0 (closed) to 1 (open); the leaflets turn from closed_angle to open_angle", 0),
  }, opening, true, check_values, make_patches, check_states};
  kind.housing = RIIS_LEAFLET_HOUSING;
  kind.absent = {
    {"stj", "its housing has only one radius, and no sinotubular junction"},
    {"skirt_length", "its ring closes the gap to the wall; ring_height sets the height of the ring"},
    {"effective_height", "only cusps have an effective height; hinge_height and closed_angle determine the height "
                         "of rigid leaflets"},
  };
  kind.is_rigid = true;
  return kind;
}
// clang-format on

void check_values(const ParameterValues &values) {
  const Reference reference{"radius", values[radius][0]};
  const auto check = [&](Parameter parameter, double least, double most) {
    check_ratio(bileaflet_valve_kind().parameters[parameter], values[parameter], reference, least, most);
  };
  check(hinge_offset, 0, 0.9);
  check(hinge_height, 0, 10);
  check(gap, 0, 1);
  if (values[ring_height][0] != 0) check(ring_height, 0.01, 10);
  if (!(values[closed_angle][0] < values[open_angle][0]))
    fail(RIIS_INVALID_PARAMETER, "closed_angle is ", values[closed_angle][0],
         "; it must be less than open_angle, which is ", values[open_angle][0]);
}

void check_states(const ValveState &valve, const ValveState &other, const char *name) {
  const double own = valve.values[ring_height][0], others = other.values[ring_height][0];
  if ((own == 0) != (others == 0))
    fail(RIIS_INVALID_PARAMETER, "ring_height is ", own, " in the valve and ", others, " in ", name,
         ": both must have a ring, or neither");
}

// A valve at one opening. The valve's lengths are blended between the two states.
struct Shape {
  double radius, hinge_offset, hinge_height, gap, ring_height;
  double closed_angle;  // the angle at which the outline of the leaflets fits the housing
  double angle;         // the present angle between the leaflets and the orifice plane
};

Shape blended(const ValveState &closed, const ValveState &open, double at) {
  // A value that is equal in both states is not blended, so that a housing that does not move keeps its bits.
  const auto both = [&](Parameter parameter) {
    const double from = closed.values[parameter][0], to = open.values[parameter][0];
    return from == to ? from : blend(from, to, at);
  };
  return {both(radius),
          both(hinge_offset),
          both(hinge_height),
          both(gap),
          both(ring_height),
          both(closed_angle),
          blend(closed.values[closed_angle][0], open.values[open_angle][0], at)};
}

// Turns a point (x, y) of the orifice plane into a point of the leaflet on the side x > 0. On the closed leaflet, seen along the
// axis, this point is at (x, y).
class Turn {
 public:
  explicit Turn(const Shape &shape)
      : offset_(shape.hinge_offset),
        height_(shape.hinge_height),
        closed_(sine_cosine_degrees(shape.closed_angle)),
        now_(sine_cosine_degrees(shape.angle)) {}

  // The first coordinate is offset + (x - offset) cos(angle) / cos(closed_angle). The order of the operations gives exactly x for
  // a closed leaflet.
  Vec3 operator()(double x, double y) const {
    const double along = (x - offset_) / closed_.cosine;
    return {x + along * (now_.cosine - closed_.cosine), y, height_ + along * now_.sine};
  }

  // Bounds the factor by which lines become longer on the leaflet than they are in the orifice plane.
  double stretch() const { return 1 / closed_.cosine; }

 private:
  double offset_, height_;
  SineCosine closed_, now_;
};

// Every arc has `n_spans` spans. A quarter of a circle then deviates from the true circle by at most 1e-9 of the radius.
constexpr int n_spans = 8;

// Bounds the distance of an arc's spans from the circle, in radii. For a span of the angle a, the distance is 2/27 sin^6(a/4) /
// cos^2(a/4).
double arc_deviation(double whole_angle) {
  const double quarter = 0.25 * whole_angle / n_spans;
  const auto [sine, cosine] = sine_cosine(quarter);
  constexpr double rounding = 1e-3;  // a margin for the bound's own rounding, as a share of the bound
  const double cube = sine * sine * sine;
  return (1 + rounding) * (2.0 / 27.0) * cube * cube / (cosine * cosine);
}

// Returns the arc of a circle about the axis, from (radius, 0) to the point (last_x, last_y) of the circle, where last_y > 0.
// `placed` turns a point of the plane, such as a control point, into a point in space.
template <class ToSpace>
Curve make_arc(double circle_radius, double whole_angle, double last_x, double last_y, const ToSpace &placed) {
  const double step = whole_angle / n_spans;
  const SineCosine quarter = sine_cosine(0.25 * step);
  const double reach = 4.0 / 3.0 * quarter.sine / quarter.cosine;
  struct Point {
    double x, y;
  };
  const auto on_circle = [&](int i) {
    if (i == 0) return Point{circle_radius, 0};
    if (i == n_spans) return Point{last_x, last_y};
    const SineCosine at = sine_cosine(i * step);
    return Point{circle_radius * at.cosine, circle_radius * at.sine};
  };
  Vector<Bezier> spans;
  for (int i = 0; i < n_spans; ++i) {
    const Point from = on_circle(i), to = on_circle(i + 1);
    // The tangent at a point of the circle is the point's radius vector, turned by 90 degrees.
    spans.push_back(Bezier::cubic(placed(from.x, from.y), placed(from.x - reach * from.y, from.y + reach * from.x),
                                  placed(to.x + reach * to.y, to.y - reach * to.x), placed(to.x, to.y)));
  }
  return Curve(std::move(spans));
}

const Rotation &half_turn() {
  static const Rotation &turn = *new Rotation(rotation_about({0, 0, 1}, 180));
  return turn;
}

// Returns an image of the quarter of the valve with x > 0 and y > 0.
PatchImage image_of(bool is_mirrored, bool is_turned, std::int32_t leaflet_id, std::int32_t patch_id) {
  return {is_mirrored ? Mirror::in_y : Mirror::none,
          is_turned ? half_turn() : no_rotation,
          {0, 0, 0},
          leaflet_id,
          patch_id};
}

void add_leaflets(const Shape &shape, PatchSet &set) {
  const Turn turn(shape);
  const double R = shape.radius, x0 = 0.5 * shape.gap, y_end = std::sqrt((R - x0) * (R + x0));
  const double whole_angle = arc_tangent(y_end, x0);
  const Vec3 apex = turn(R, 0), middle = turn(x0, 0), end = turn(x0, y_end);
  const Side rim = set.add(make_arc(R, whole_angle, x0, y_end, turn)), edge = set.add(Bezier::line(middle, end));
  const Side symmetry = set.add(Bezier::line(apex, middle)), corner = set.add(Bezier::point(end));
  // u runs from the symmetry plane to the corner, and v from the rim to the middle edge. S_u x S_v therefore points downstream.
  Patch patch{rim, edge, symmetry, corner, {}};
  for (const std::int32_t leaflet_id : {RIIS_LEAFLET_POSITIVE, RIIS_LEAFLET_NEGATIVE})
    for (const bool is_mirrored : {false, true})
      patch.images.push_back(image_of(is_mirrored, leaflet_id == RIIS_LEAFLET_NEGATIVE, leaflet_id,
                                      2 * leaflet_id + (is_mirrored ? 1 : 0)));
  set.patches.push_back(patch);
  set.deviation = std::max(set.deviation, R * turn.stretch() * arc_deviation(whole_angle));
}

void add_ring(const Shape &shape, PatchSet &set) {
  const double R = shape.radius, whole_angle = 0.5 * pi;
  const auto arc_at = [&](double z) {
    return set.add(make_arc(R, whole_angle, 0, R, [z](double x, double y) { return Vec3{x, y, z}; }));
  };
  const double upper = 0.5 * shape.ring_height, lower = -upper;
  const Side bottom = arc_at(lower), top = arc_at(upper);
  const Side first = set.add(Bezier::line({R, 0, lower}, {R, 0, upper}));
  const Side last = set.add(Bezier::line({0, R, lower}, {0, R, upper}));
  // u runs around the axis, and v runs downstream. S_u x S_v therefore points outwards.
  Patch patch{bottom, top, first, last, {}};
  std::int32_t patch_id = 4;
  for (const bool is_turned : {false, true})
    for (const bool is_mirrored : {false, true})
      patch.images.push_back(image_of(is_mirrored, is_turned, RIIS_LEAFLET_HOUSING, patch_id++));
  set.patches.push_back(patch);
  set.deviation = std::max(set.deviation, R * arc_deviation(whole_angle));
}

PatchSet make_patches(const ValveState &closed, const ValveState &open, double at) {
  check_states(closed, open, "the open state");
  if (!(closed.values[closed_angle][0] < open.values[open_angle][0]))
    fail(RIIS_INVALID_PARAMETER, "open_angle is ", open.values[open_angle][0],
         " in the open state; it must be more than the valve's closed_angle, which is ",
         closed.values[closed_angle][0]);
  const Shape shape = blended(closed, open, at);
  PatchSet set;
  add_leaflets(shape, set);
  if (shape.ring_height != 0) add_ring(shape, set);
  return set;
}

}  // namespace

const ValveKind &bileaflet_valve_kind() {
  static const ValveKind &kind = *new ValveKind(make_kind());
  return kind;
}

}  // namespace riis
