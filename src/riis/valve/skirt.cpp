// SPDX-License-Identifier: Apache-2.0
#include "valve/skirt.hpp"

#include <riis/riis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "common/elementary.hpp"

namespace riis {
namespace {

// If a skirt has the same length everywhere, it has `n_even_parts` parts on each side of a patch. The outer edge then has an
// error of at most a thousandth of the length (tests/surface/test_skirt.c).
constexpr std::size_t n_even_parts = 8;
// Two ends of cusps that are not joined count as neighbours if their distance is at most `most_between_ends` times the longest
// side.
constexpr double most_between_ends = 0.5;
// The line through two neighbouring ends makes an angle with the outward direction. The skirts lead along this line if the sine
// of the angle is between these two numbers. The sine is positive if the ends have passed each other. Outside of this range, the
// skirts use a sine that decreases to 0.
constexpr double most_apart_in_line = -0.5, most_past_in_line = 0.98;
// The sine that the skirts use also falls to 0 where the line is nearly parallel to the axis. There the sine of the angle between
// line and axis is below `least_sine_to_axis`.
constexpr double least_sine_to_axis = 0.2;
// A side makes an angle with the plane across the axis. If the sine of this angle is at least `least_rise`, the skirt leans as
// the side's tangent does. Beside a flatter side the skirt leans less, and beside a side in the plane it does not lean.
constexpr double least_rise = 0.5;
// In some valves the skirt is not turned at rest, although the rule for neighbouring ends would turn it. If a warp hardly changes
// the turn by this rule, the skirt is turned only by the change. If the change is `most_turn_as_at_rest` or more, the skirt is
// turned by the whole new turn. Between these cases, there is a gradual transition.
constexpr double most_turn_as_at_rest = pi / 4;
// To warp an axis, a disc about the axis is warped. The disc has `n_corners` corners.
constexpr int n_corners = 24;
// The derivative of a turned direction is a difference between two points. Each point is `direction_step` times the side's length
// away from the place.
constexpr double direction_step = 1e-4;

Vec3 without_placement(const PatchImage &image, Vec3 p) {
  const Vec3 turned = transposed(image.rotation) * p;
  return {image.mirror == Mirror::in_x ? -turned.x : turned.x, image.mirror == Mirror::in_y ? -turned.y : turned.y,
          turned.z};
}

// A point of a curve, and the step from there to the next point of the curve.
struct Step {
  Vec3 at, by;
};

// Returns evenly spaced points of a curve, with the steps between them.
Vector<Step> steps_of(const Curve &curve) {
  constexpr int n = 8;
  Vector<Step> steps;
  steps.reserve(n * curve.spans().size());
  for (const Bezier &span : curve.spans())
    for (int i = 0; i < n; ++i) {
      const double t = (i + 0.5) / n;
      steps.push_back({evaluate(span, t), (1.0 / n) * derivative(span, t)});
    }
  return steps;
}

Vector<Step> steps_of_attachment(const PatchSet &set, const Vector<HeldSide> &sides) {
  Vector<Step> steps;
  for (const HeldSide &held : sides) {
    const Vector<Step> of_side = steps_of(along(set, held.side));
    for (const PatchImage &image : set.patches[held.patch].images) {
      const PatchImage turn = turn_of(image);
      // In a mirror image, the sides run around the axis in the opposite direction. The same holds for a patch that a warp has
      // made from a mirror image.
      const double sign = points_upstream(image) ? -1 : 1;
      for (const Step &step : of_side) steps.push_back({place(image, step.at), sign * place(turn, step.by)});
    }
  }
  return steps;
}

// Returns the axis of a patch after an image is placed.
AxisLine placed(const AxisLine &axis, const PatchImage &image) {
  return {place(image, axis.centre), place(turn_of(image), axis.direction)};
}

bool are_equal(const AxisLine &a, const AxisLine &b) { return a.centre == b.centre && a.direction == b.direction; }

// Returns the line to which the map takes an axis. `steps` has points of the attachment around the axis. The map warps a disc
// about the axis. The disc has the mean height and the mean radius of these points. The middle and the vector area of the warped
// disc give the line.
AxisLine warped_axis(const AxisLine &axis, const Vector<Step> &steps, const BlendedWarp &warp) {
  double whole = 0, height = 0, radius = 0;
  for (const Step &step : steps) {
    const double weight = length(step.by), along = dot(step.at - axis.centre, axis.direction);
    whole += weight, height += weight * along;
    radius += weight * distance(step.at, axis.centre + along * axis.direction);
  }
  if (!(whole > 0 && radius > 0)) return axis;
  const Vec3 middle = axis.centre + (height / whole) * axis.direction, &a = axis.direction;
  const Vec3 aside = std::abs(a.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, across = cross(a, aside);
  const Vec3 v = (1 / length(across)) * across, u = cross(v, a);
  Vector<Vec3> corners;
  Vec3 sum{0, 0, 0}, area{0, 0, 0};
  for (int i = 0; i < n_corners; ++i) {
    const SineCosine angle = sine_cosine(2 * pi * i / n_corners);
    corners.push_back(warp.value(middle + (radius / whole) * (angle.cosine * u + angle.sine * v)));
    sum = sum + corners.back();
  }
  const Vec3 centre = (1.0 / n_corners) * sum;
  for (std::size_t i = 0; i < corners.size(); ++i)
    area = area + cross(corners[i] - centre, corners[(i + 1) % corners.size()] - centre);
  const double size = length(area);
  return {centre, size > 0 ? (1 / size) * area : Vec3{0, 0, 0}};
}

// Returns the line through the centroid of the attachment. The line is vertical if `axis` is SkirtAxis::vertical. Otherwise it
// leads along the attachment's vector area. The direction has the length 1, or 0 if the attachment encloses no area.
AxisLine axis_of_attachment(const PatchSet &set, const Vector<HeldSide> &sides, SkirtAxis axis) {
  const Vector<Step> steps = steps_of_attachment(set, sides);
  double whole = 0;
  Vec3 sum{0, 0, 0};
  for (const Step &step : steps) {
    const double weight = length(step.by);
    whole += weight;
    sum = sum + weight * step.at;
  }
  const Vec3 centre = whole > 0 ? (1 / whole) * sum : Vec3{0, 0, 0};
  if (axis == SkirtAxis::vertical) return {centre, {0, 0, 1}};
  Vec3 area{0, 0, 0};
  for (const Step &step : steps) area = area + 0.5 * cross(step.at - centre, step.by);
  // A circle of this length has the area whole^2 / (4 pi).
  const double size = length(area);
  return {centre, size > 1e-3 * whole * whole ? (1 / size) * area : Vec3{0, 0, 0}};
}

// Adds the curves and patches of a skirt to a set.
class SkirtMaker {
 public:
  SkirtMaker(PatchSet &set, const Vector<HeldSide> &sides)
      : set_(set), sides_(sides), directions_(set, sides), leaflet_id_(skirt_leaflet(set)) {
    for (const Patch &patch : set.patches)
      for (const PatchImage &image : patch.images) n_ids_ = std::max(n_ids_, image.patch_id + 1);
  }

  // Adds the strip along a side of a patch, for these images of the patch. `lengths` has the skirt's lengths at evenly spaced
  // shares of the side.
  void add(std::size_t side, std::size_t first_image, std::size_t n_images, const Vector<double> &lengths) {
    const HeldSide &held = sides_[side];
    const Patch parent = set_.patches[held.patch];
    const Curve inner = along(set_, held.side), outer = outer_curve(side, inner, parent, lengths);
    const std::size_t rim = add_curve(outer);
    Patch strip{{rim}, held.side, {line(outer.first(), inner.first())}, {line(outer.last(), inner.last())}, {}};
    if (!set_.material.empty()) {
      set_.material.resize(set_.curves.size());
      set_.material[rim] = material_of_outer(inner, held.side, outer);
    }
    for (std::size_t i = first_image; i < first_image + n_images; ++i) {
      PatchImage image = parent.images[i];
      image.leaflet_id = leaflet_id_;
      image.patch_id += n_ids_;
      places_[{held.patch, i}] = {set_.patches.size(), strip.images.size()};
      strip.images.push_back(image);
    }
    strip.is_skirt = true;
    if (parent.bulge != 0) strip.skirt_of_arcs = held.patch;
    set_.patches.push_back(std::move(strip));
  }

  // Sews two strips together if their patches are sewn together at the end of the attached sides.
  void sew() {
    const Vector<Seam> seams = set_.seams;
    for (const Seam &seam : seams) {
      if (set_.patches[seam.patch].attached != AttachedSide::u1) continue;
      const auto own = places_.find({seam.patch, seam.image}), other = places_.find({seam.patch_of_twin(), seam.twin});
      if (own == places_.end() || other == places_.end()) continue;
      set_.seams.push_back({own->second[0], own->second[1], other->second[1], SeamPlace::side_u1, other->second[0]});
    }
  }

 private:
  std::size_t add_curve(const Curve &curve) {
    set_.curves.push_back(curve);
    return set_.curves.size() - 1;
  }

  // Returns the curve between two points. Two strips that meet share the line between them.
  std::size_t line(Vec3 outer, Vec3 inner) {
    const auto [found, is_new] = lines_.try_emplace({outer.x, outer.y, outer.z, inner.x, inner.y, inner.z}, 0);
    if (is_new) found->second = add_curve(Bezier::line(outer, inner));
    return found->second;
  }

  // Returns the derivative of the length at one of the shares, per step between shares. With this derivative, the length between
  // two shares stays between the lengths at these shares. A skirt thus does not overshoot at a corner of the wall (F. N. Fritsch,
  // R. E. Carlson 1980).
  static double growth_at(const Vector<double> &lengths, std::size_t i) {
    const double before = i == 0 ? 0 : lengths[i] - lengths[i - 1];
    const double after = i + 1 == lengths.size() ? 0 : lengths[i + 1] - lengths[i];
    if (i == 0) return after;
    if (i + 1 == lengths.size()) return before;
    if (!(before * after > 0)) return 0;
    const double most = 2 * std::min(std::abs(before), std::abs(after)), mean = 0.5 * (before + after);
    return std::clamp(mean, -most, most);
  }

  // Each part of the curve is a cubic. At both ends, the cubic has the exact point, and the exact derivative with respect to the
  // share of length.
  Curve outer_curve(std::size_t side, const Curve &inner, const Patch &parent, const Vector<double> &lengths) const {
    const std::size_t n = lengths.size() - 1;
    const double step = 1 / static_cast<double>(n);
    const auto point = [&](std::size_t i) {
      const double share = step * static_cast<double>(i);
      const Vec3 p = i == 0 ? inner.first() : i == n ? inner.last() : inner.at(share);
      return p + lengths[i] * directions_.at(side, share, p);
    };
    const auto slope = [&](std::size_t i) {
      const auto [p, tangent] = inner.with_tangent(step * static_cast<double>(i));
      const Vec3 d = parent.axis.direction, from_axis = p - parent.axis.centre;
      const Vec3 q = from_axis - dot(from_axis, d) * d, out = outwards(parent.axis, p);
      const Vec3 along = inner.length() * tangent, across = along - dot(along, d) * d;
      const Vec3 turn = (1 / length(q)) * (across - dot(across, out) * out);
      const double growth = growth_at(lengths, i) / step;
      if (directions_.is_turned(side)) {
        const double here = step * static_cast<double>(i), from = std::max(0.0, here - direction_step),
                     to = std::min(1.0, here + direction_step);
        const Vec3 change = directions_.at(side, to, inner.at(to)) - directions_.at(side, from, inner.at(from));
        return along + (lengths[i] / (to - from)) * change + growth * directions_.at(side, here, p);
      }
      return along + lengths[i] * turn + growth * out;
    };
    Vector<Bezier> spans;
    Vec3 from = point(0), from_slope = slope(0);
    for (std::size_t i = 1; i <= n; ++i) {
      const Vec3 to = point(i), to_slope = slope(i);
      spans.push_back(Bezier::cubic(from, from + (step / 3) * from_slope, to - (step / 3) * to_slope, to));
      from = to, from_slope = to_slope;
    }
    return Curve(std::move(spans));
  }

  // Returns the material points of the outer side. The points of the outer side lie outwards from those of the inner side.
  MaterialPoints material_of_outer(const Curve &inner, const Side &side, const Curve &outer) const {
    const MaterialPoints &given = *set_.material[side.curve];
    const MaterialPoints points = side.reversed ? given.reversed(inner.spans().size()) : given;
    const auto n_parts = static_cast<double>(outer.spans().size());
    MaterialPoints made{};
    for (std::size_t k = 0; k < n_material; ++k) {
      const PointOnSpan &at = view(points.on_curve)[k];
      double share = k == n_material - 1 ? 1 : 0;
      if (k > 0 && k + 1 < n_material) {
        for (std::size_t span = 0; span < at.span; ++span) share += inner.length(span);
        share = std::min(1.0, (share + arc_length(inner.spans()[at.span], 0, at.t)) / inner.length());
      }
      const double part = std::min(std::floor(share * n_parts), n_parts - 1);
      view(made.on_curve)[k] = {static_cast<std::size_t>(part), share * n_parts - part};
    }
    locate_on_curve(outer, made);
    for (std::size_t k = 0; k < n_material; ++k)
      view(made.mapped)[k] = view(made.point)[k] + (view(points.mapped)[k] - view(points.point)[k]);
    return made;
  }

  PatchSet &set_;
  const Vector<HeldSide> &sides_;
  SkirtDirections directions_;
  std::int32_t leaflet_id_, n_ids_ = 0;
  std::map<std::array<double, 6>, std::size_t> lines_;
  std::map<std::array<std::size_t, 2>, std::array<std::size_t, 2>> places_;  // key: a patch and its image
};

// An end of a held side of an image. On the way around the axis, each side has a first and a last end. `is_before` is true for
// the last end.
struct PlacedEnd {
  AttachedEnd end;
  Vec3 point;
  std::int32_t leaflet_id;
  bool is_before;
  AxisLine axis;
  Vec3 tangent;
};

// Returns the line midway between two axes.
AxisLine between(const AxisLine &a, const AxisLine &b) {
  if (are_equal(a, b)) return a;
  const Vec3 direction = a.direction + b.direction;
  return {0.5 * (a.centre + b.centre), (1 / length(direction)) * direction};
}

// Returns the angle about the axis from one vector to another, in radians.
double angle_about(const AxisLine &axis, Vec3 from, Vec3 to) {
  return arc_tangent(dot(cross(from, to), axis.direction), dot(from, to));
}

// Returns two angles, one for each of two neighbouring ends. Each is the angle from the outward direction of the end's own axis
// to the direction that direction_between returns.
std::array<double, 2> turns_between(const AxisLine &axis_before, const SideEnd &before, const AxisLine &axis_after,
                                    const SideEnd &after) {
  const Vec3 direction = direction_between(between(axis_before, axis_after), before, after);
  return {angle_about(axis_before, outwards(axis_before, before.point), direction),
          angle_about(axis_after, outwards(axis_after, after.point), direction)};
}

Vector<PlacedEnd> placed_ends(const PatchSet &set, const Vector<HeldSide> &sides) {
  Vector<std::size_t> first_number;
  std::size_t n_images = 0;
  for (const Patch &patch : set.patches) first_number.push_back(n_images), n_images += patch.images.size();
  Vector<PlacedEnd> places;
  for (const HeldSide &held : sides) {
    const Curve &curve = set.curve_of(held.side);
    const Patch &patch = set.patches[held.patch];
    for (std::size_t i = 0; i < patch.images.size(); ++i)
      for (const bool is_last : {false, true}) {
        const PatchImage &image = patch.images[i];
        const bool is_last_of_curve = is_last != held.side.reversed;
        // If a patch points upstream, its side runs in the opposite sense around the axis.
        places.push_back({{first_number[held.patch] + i, is_last},
                          place(image, is_last_of_curve ? curve.last() : curve.first()),
                          image.leaflet_id,
                          is_last != points_upstream(image),
                          placed(patch.axis, image),
                          place(turn_of(image), curve.with_tangent(is_last_of_curve ? 1 : 0).tangent)});
      }
  }
  return places;
}

}  // namespace

Vec3 outwards(const AxisLine &axis, Vec3 point) {
  const Vec3 from_axis = point - axis.centre, q = from_axis - dot(from_axis, axis.direction) * axis.direction;
  const double size = length(q);
  return size > 0 ? Vec3{q.x / size, q.y / size, q.z / size} : Vec3{0, 0, 0};
}

Vector<NeighbourEnds> neighbour_ends(const PatchSet &set, bool wants_turns) {
  const Vector<HeldSide> sides = held_sides(set);
  const Vector<PlacedEnd> places = placed_ends(set, sides);
  double size = 0;
  for (const HeldSide &held : sides) size = std::max(size, set.curve_of(held.side).length());
  Vector<const PlacedEnd *> free;
  for (const PlacedEnd &at : places)
    if (std::none_of(places.begin(), places.end(), [&](const PlacedEnd &other) {
          return &other != &at && distance(other.point, at.point) <= 1e-9 * size;
        }))
      free.push_back(&at);
  const auto nearest_to = [&](const PlacedEnd &at) {
    const PlacedEnd *nearest = nullptr;
    for (const PlacedEnd *other : free)
      if (other->leaflet_id != at.leaflet_id && other->is_before != at.is_before &&
          (!nearest || distance(other->point, at.point) < distance(nearest->point, at.point)))
        nearest = other;
    return nearest;
  };
  Vector<NeighbourEnds> made;
  for (const PlacedEnd *at : free) {
    if (!at->is_before) continue;
    const PlacedEnd *other = nearest_to(*at);
    if (!other || nearest_to(*other) != at || distance(other->point, at->point) > most_between_ends * size) continue;
    made.push_back({at->end, other->end});
    if (wants_turns)
      made.back().turns_at_rest =
          turns_between(at->axis, {at->point, at->tangent}, other->axis, {other->point, other->tangent});
  }
  return made;
}

Vec3 direction_between(const AxisLine &axis, const SideEnd &before, const SideEnd &after) {
  // Seen along `rise`, the two sides lead away from their ends in opposite directions: one to the left, one to the right. The
  // planes of the skirts' ends contain the vector `rise`.
  const auto lean = [&](Vec3 tangent) {
    const double up = dot(tangent, axis.direction);
    return (up / std::max(least_rise * least_rise, up * up)) * (tangent - up * axis.direction);
  };
  const Vec3 rise = axis.direction + 0.5 * (lean(before.tangent) + lean(after.tangent));
  const Vec3 between = after.point - before.point, across = between - dot(between, axis.direction) * rise;
  const Vec3 out = outwards(axis, 0.5 * (before.point + after.point)), onwards = cross(axis.direction, out);
  const double apart = length(across);
  if (!(apart > 0)) return out;
  // The skirts at both ends are turned towards that end which lies farther outwards.
  const double along_out = dot(across, out), past = -dot(across, onwards) / apart;
  double sine = past;
  if (past > most_past_in_line) sine = most_past_in_line * (1 - past) / (1 - most_past_in_line);
  if (past < most_apart_in_line) sine = most_apart_in_line * (1 + past) / (1 + most_apart_in_line);
  sine *= std::min(1.0, apart / (least_sine_to_axis * length(between)));
  return std::sqrt(1 - sine * sine) * out + (along_out < 0 ? sine : -sine) * onwards;
}

SkirtDirections::SkirtDirections(const PatchSet &set, const Vector<HeldSide> &sides) {
  for (const HeldSide &held : sides) {
    axes_.push_back(set.patches[held.patch].axis);
    ends_.push_back({End{false, {}, {}}, End{false, {}, {}}});
  }
  const auto side_of = [&](const AttachedEnd &end) {
    const auto found =
        std::find_if(sides.begin(), sides.end(), [&](const HeldSide &held) { return held.patch == end.patch; });
    return static_cast<std::size_t>(found - sides.begin());
  };
  for (const NeighbourEnds &ends : set.neighbour_ends) {
    const std::size_t before = side_of(ends.before), after = side_of(ends.after);
    if (before == sides.size() || after == sides.size()) continue;
    const auto end = [&](std::size_t side, bool is_last) {
      const Curve &curve = set.curve_of(sides[side].side);
      const bool is_last_of_curve = is_last != sides[side].side.reversed;
      return SideEnd{is_last_of_curve ? curve.last() : curve.first(),
                     curve.with_tangent(is_last_of_curve ? 1 : 0).tangent};
    };
    const SideEnd at_before = end(before, ends.before.is_last), at_after = end(after, ends.after.is_last);
    End &turned_before = view(ends_[before])[ends.before.is_last ? 1 : 0],
        &turned_after = view(ends_[after])[ends.after.is_last ? 1 : 0];
    if (ends.turns_at_rest) {
      // Returns the turn that the warp adds. Without a warp, the skirt is not turned.
      const std::array<double, 2> now = turns_between(axes_[before], at_before, axes_[after], at_after);
      const auto added = [&](std::size_t i) {
        const double rest = view(*ends.turns_at_rest)[i];
        return view(now)[i] - rest * std::max(0.0, 1 - std::abs(view(now)[i] - rest) / most_turn_as_at_rest);
      };
      turned_before = {true, {}, added(0)}, turned_after = {true, {}, added(1)};
    } else {
      turned_before = turned_after = {true, direction_between(axes_[before], at_before, at_after), {}};
    }
  }
}

Vec3 SkirtDirections::at(std::size_t side, double share, Vec3 point) const {
  Vec3 out = outwards(axes_[side], point);
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
    const End &turned = view(ends_[side])[end];
    if (!turned.is_turned) continue;
    const double s = end == 0 ? 1 - share : share, weight = s * s * (3 - 2 * s);
    if (turned.angle) {
      const SineCosine angle = sine_cosine(weight * *turned.angle);
      out = angle.cosine * out + angle.sine * cross(axes_[side].direction, out);
    } else {
      out = mix(out, turned.direction, weight);
      out = (1 / length(out)) * out;
    }
  }
  return out;
}

double attachment_radius(const PatchSet &set, const Vector<HeldSide> &sides) {
  if (sides.empty())
    fail(RIIS_INVALID_PARAMETER,
         "a skirt needs an attachment, but the valve has none: each side v = 0 belongs to several patches");
  double sum = 0;
  for (const HeldSide &held : sides) {
    const AxisLine &axis = set.patches[held.patch].axis;
    if (axis.direction == Vec3{0, 0, 0})
      fail(RIIS_INVALID_PARAMETER, "a skirt has no direction, because the attachment encloses no area");
    const Curve &curve = set.curve_of(held.side);
    for (const double share : {0.0, 0.5, 1.0}) {
      const Vec3 p = curve.at(share), q = p - axis.centre;
      const double radius = length(q - dot(q, axis.direction) * axis.direction);
      if (!(radius > 1e-6 * curve.length()))
        fail(RIIS_INVALID_PARAMETER, "a skirt has no direction at (", p.x, ", ", p.y, ", ", p.z,
             "), where the attachment reaches its axis");
      sum += radius;
    }
  }
  return sum / static_cast<double>(3 * sides.size());
}

Vector<HeldSide> held_sides(const PatchSet &set) {
  Vector<std::size_t> n_uses(set.curves.size(), 0);
  for (const Patch &patch : set.patches)
    for (const Side &side : {patch.v0, patch.v1, patch.u0, patch.u1}) ++n_uses[side.curve];
  Vector<HeldSide> sides;
  for (std::size_t i = 0; i < set.patches.size(); ++i) {
    const Patch &patch = set.patches[i];
    if (patch.attached == AttachedSide::none) continue;
    const Side side = patch.attached == AttachedSide::v0 ? patch.v0 : patch.u1;
    if (n_uses[side.curve] == 1 && set.curve_of(side).length() > 0) sides.push_back({i, side});
  }
  return sides;
}

void aim_skirt(PatchSet &set, SkirtAxis axis) {
  if (axis == SkirtAxis::none || axis == SkirtAxis::of_cusp)
    return;  // the patches of these valves already have the axis of their cusp
  const Vector<HeldSide> sides = held_sides(set);
  const AxisLine whole = axis_of_attachment(set, sides, axis);
  for (const HeldSide &held : sides) {
    Patch &patch = set.patches[held.patch];
    const PatchImage &image = patch.images.front();
    const PatchImage turn = turn_of(image);
    patch.axis = {without_placement(turn, whole.centre - image.translation), without_placement(turn, whole.direction)};
    // A plane of symmetry contains the line. Mirror images meet only in this plane, so rounding must not move the line out of it.
    for (const PatchImage &other : patch.images) {
      if (other.mirror == Mirror::in_x) patch.axis.centre.x = patch.axis.direction.x = 0;
      if (other.mirror == Mirror::in_y) patch.axis.centre.y = patch.axis.direction.y = 0;
    }
  }
}

void aim_warped_skirt(PatchSet &set, const PatchSet &at_rest, const BlendedWarp &warp) {
  // Sides that have the same axis at rest also get the same axis after the warp, so that their strips meet. Cusps with separate
  // axes at rest get separate axes after the warp.
  struct Group {
    AxisLine axis;
    Vector<Step> steps;
  };
  Vector<Group> groups;
  const auto group_of = [&](const AxisLine &axis) -> Group & {
    for (Group &group : groups)
      if (are_equal(group.axis, axis)) return group;
    groups.push_back({axis, {}});
    return groups.back();
  };
  for (const HeldSide &held : held_sides(at_rest)) {
    const Patch &patch = at_rest.patches[held.patch];
    const Vector<Step> of_side = steps_of(along(at_rest, held.side));
    for (const PatchImage &image : patch.images) {
      Group &group = group_of(placed(patch.axis, image));
      for (const Step &step : of_side) group.steps.push_back({place(image, step.at), place(turn_of(image), step.by)});
    }
  }
  Vector<AxisLine> lines;
  for (const Group &group : groups) lines.push_back(warped_axis(group.axis, group.steps, warp));
  std::size_t number = 0;
  for (const Patch &patch : at_rest.patches)
    for (const PatchImage &image : patch.images) {
      AxisLine &axis = set.patches[number++].axis;
      for (std::size_t i = 0; i < groups.size(); ++i)
        if (patch.attached != AttachedSide::none && are_equal(groups[i].axis, placed(patch.axis, image)))
          axis = lines[i];
    }
}

std::int32_t skirt_leaflet(const PatchSet &set) {
  std::int32_t id = RIIS_LEAFLET_SKIRT;
  for (const Patch &patch : set.patches)
    for (const PatchImage &image : patch.images)
      if (!patch.is_skirt) id = std::max(id, image.leaflet_id + 1);
  return id;
}

void add_skirt(PatchSet &set, double length, const SkirtLengths &lengths) {
  const Vector<HeldSide> sides = held_sides(set);
  const double radius = attachment_radius(set, sides);
  SkirtMaker maker(set, sides);
  if (lengths.empty()) {
    if (!(length >= least_skirt * radius && length <= most_skirt * radius))
      fail(RIIS_INVALID_PARAMETER, "skirt_length is ", length, "; it must be 0, or from ", least_skirt, " to ",
           most_skirt, " times the mean distance of the attachment from its axis, which is ", rounded(radius, 4));
    const Vector<double> even(n_even_parts + 1, length);
    for (std::size_t side = 0; side < sides.size(); ++side)
      maker.add(side, 0, set.patches[sides[side].patch].images.size(), even);
  } else {
    std::size_t next = 0;
    for (std::size_t side = 0; side < sides.size(); ++side)
      for (std::size_t i = 0, n = set.patches[sides[side].patch].images.size(); i < n; ++i)
        maker.add(side, i, 1, lengths[next++]);
  }
  maker.sew();
}

}  // namespace riis
