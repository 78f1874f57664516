// SPDX-License-Identifier: Apache-2.0
#include "motion/displacement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/errors.hpp"
#include "geometry/bezier.hpp"
#include "valve/warp.hpp"

namespace riis {

Vector<Vec3> arc_offsets(const PatchSet &set, const Patch &patch, const CurvePoints &base, const CurvePoints &edge) {
  Vector<Vec3> made(base.size(), Vec3{0, 0, 0});
  if (patch.bulge == 0) return made;
  for (std::size_t i = 1; i + 1 < made.size(); ++i)
    made[i] = arc_offset(edge.point(i) - base.point(i), base.tangent(i), patch.bulge);
  made.front() = arc_offset(set, patch.u0), made.back() = arc_offset(set, patch.u1);
  return made;
}

namespace {

// The material points of a side, in the order of the side's own direction.
class PointsOfSide {
 public:
  PointsOfSide(const PatchSet &set, const Side &side)
      : curve_(set.curves[side.curve]), points_(*set.material[side.curve]), is_reversed_(side.reversed) {}

  Vec3 mapped(std::size_t k) const { return points_.mapped[at(k)]; }
  Vec3 point(std::size_t k) const { return points_.point[at(k)]; }
  double share(std::size_t k) const { return is_reversed_ ? 1 - points_.share[at(k)] : points_.share[at(k)]; }
  // Returns the unit tangent, or 0 if the curve has no direction there.
  Vec3 tangent(std::size_t k) const {
    const PointOnSpan &where = points_.on_curve[at(k)];
    const Vec3 along = derivative(curve_.spans()[where.span], where.t);
    const double speed = length(along);
    return speed > 0 ? ((is_reversed_ ? -1 : 1) / speed) * along : Vec3{0, 0, 0};
  }

 private:
  std::size_t at(std::size_t k) const { return is_reversed_ ? n_material - 1 - k : k; }

  const Curve &curve_;
  const MaterialPoints &points_;
  bool is_reversed_;
};

bool has_material(const PatchSet &set, const Side &side) {
  return side.curve < set.material.size() && set.material[side.curve];
}

}  // namespace

SideMaterial::SideMaterial(const MovedPatch &moved, Side Patch::*side) {
  const Side &now = moved.now.patches[moved.patch].*side, &before = moved.before.patches[moved.patch].*side;
  is_warped_ = has_material(moved.now, now) && has_material(moved.before, before);
  if (!is_warped_) return;
  const PointsOfSide at_now(moved.now, now), at_before(moved.before, before);
  std::array<double, n_material> slide{};
  std::array<Vec3, n_material> rest{};
  for (std::size_t k = 0; k < n_material; ++k) {
    nodes_[k] = at_now.share(k);
    slide[k] = at_before.share(k) - nodes_[k];
    rest[k] = (at_now.mapped(k) - at_now.point(k)) - (at_before.mapped(k) - at_before.point(k));
  }
  slide_ = {nodes_, slide};
  rest_ = {nodes_, rest};
}

Vector<double> SideMaterial::shares_before(const Vector<double> &shares) const {
  Vector<double> made;
  made.reserve(shares.size());
  double last = 0;
  for (const double share : shares) made.push_back(last = std::clamp(share + slide_.at(share), last, 1.0));
  made.back() = 1;
  return made;
}

namespace {

// Steps of u and v count as nearly parallel if the squared sine of the angle between them is at most `least_sine_sq`.
constexpr double least_sine_sq = 0.01;

bool has_points_inside(const MovedPatch &moved) {
  return moved.patch < moved.now.mapped_inside.size() && moved.patch < moved.before.mapped_inside.size();
}

// The position of a point beside another point, expressed in steps of u and v by least squares. If the steps of u and v are
// nearly parallel, the position is set to 0.
struct StepsBeside {
  double u = 0, v = 0;

  StepsBeside(Vec3 along_v, Vec3 beside) {
    const double vv = dot(along_v, along_v);
    if (vv > 0) v = dot(along_v, beside) / vv;
  }
  StepsBeside(Vec3 along_u, Vec3 along_v, Vec3 beside) {
    const double uu = dot(along_u, along_u), uv = dot(along_u, along_v), vv = dot(along_v, along_v);
    const double determinant = uu * vv - uv * uv, on_u = dot(along_u, beside), on_v = dot(along_v, beside);
    if (!(determinant > least_sine_sq * uu * vv)) return;
    u = (vv * on_u - uv * on_v) / determinant;
    v = (uu * on_v - uv * on_u) / determinant;
  }
};

// The arcs at the material points of a warped patch of arcs, in one state of the valve.
struct MaterialArcs {
  MaterialArcs(const PatchSet &set, std::size_t number) : mapped_middle(set.mapped_inside[number].points) {
    const Patch &patch = set.patches[number];
    const PointsOfSide of_base(set, patch.v0), of_edge(set, patch.v1);
    for (std::size_t k = 0; k < n_material; ++k) {
      base[k] = of_base.point(k), edge[k] = of_edge.point(k);
      mapped_base[k] = of_base.mapped(k), mapped_edge[k] = of_edge.mapped(k);
      offset[k] = k == 0                ? arc_offset(set, patch.u0)
                  : k == n_material - 1 ? arc_offset(set, patch.u1)
                  : patch.bulge != 0    ? arc_offset(edge[k] - base[k], of_base.tangent(k), patch.bulge)
                                        : Vec3{0, 0, 0};
    }
  }

  Vec3 middle(std::size_t k) const { return 0.5 * (base[k] + edge[k] + offset[k]); }

  std::array<Vec3, n_material> base, edge, offset;  // values of the warped curves
  std::array<Vec3, n_material> mapped_base, mapped_edge, mapped_middle;
};

using OfSides = std::array<std::array<Vec3, n_material>, 4>;  // vectors on the sides v0, v1, u0, u1.

// The vectors at evenly spaced points on the sides of a warped patch. On each side, they are interpolated by a polynomial from
// the vectors at the shares `nodes`.
class AtShares {
 public:
  AtShares(const std::array<std::array<double, n_material>, 4> &nodes, const OfSides &values) {
    for (std::size_t side = 0; side < at_.size(); ++side) {
      const Through<Vec3> through(nodes[side], values[side]);
      at_[side] = values[side];  // at the ends, the given vectors are exact
      for (std::size_t k = 1; k < last; ++k) at_[side][k] = through.at(material_share(k));
    }
  }

  // Returns the Coons combination at two shares.
  Vec3 combined(std::size_t at_u, std::size_t at_v) const {
    const auto &[v0, v1, u0, u1] = at_;
    const double u = material_share(at_u), v = material_share(at_v);
    return mix(v0[at_u], v1[at_u], v) + mix(u0[at_v], u1[at_v], u) -
           mix(mix(v0[0], v0[last], u), mix(v1[0], v1[last], u), v);
  }
  // along_u and along_v return by how much the combination changes from the previous to the next evenly spaced share.
  Vec3 along_u(std::size_t at_u, std::size_t at_v) const {
    const auto &[v0, v1, u0, u1] = at_;
    return mix(v0[at_u + 1] - v0[at_u - 1], v1[at_u + 1] - v1[at_u - 1], material_share(at_v)) +
           material_share(2) * (u1[at_v] - u0[at_v] - mix(v0[last] - v0[0], v1[last] - v1[0], material_share(at_v)));
  }
  Vec3 along_v(std::size_t at_u, std::size_t at_v) const {
    const auto &[v0, v1, u0, u1] = at_;
    return mix(u0[at_v + 1] - u0[at_v - 1], u1[at_v + 1] - u1[at_v - 1], material_share(at_u)) +
           material_share(2) * (v1[at_u] - v0[at_u] - mix(v1[0] - v0[0], v1[last] - v0[last], material_share(at_u)));
  }

 private:
  static constexpr std::size_t last = n_material - 1;

  OfSides at_;
};

}  // namespace

Through<Vec3> rest_of_offsets(const MovedPatch &moved, const SideMaterial &base, const SideMaterial &edge) {
  if (!base.is_warped() || !edge.is_warped() || !has_points_inside(moved)) return {};
  constexpr std::size_t last = n_material - 1;
  const MaterialArcs now(moved.now, moved.patch), before(moved.before, moved.patch);
  std::array<double, n_material> nodes{};
  std::array<Vec3, n_material> rest{}, moves{};
  for (std::size_t k = 0; k <= last; ++k) moves[k] = now.mapped_middle[k] - before.mapped_middle[k];
  for (std::size_t k = 0; k <= last; ++k) {
    nodes[k] = 0.5 * (base.nodes()[k] + edge.nodes()[k]);
    const Vec3 move_of_base = now.mapped_base[k] - before.mapped_base[k],
               move_of_edge = now.mapped_edge[k] - before.mapped_edge[k];
    // The mapped middle lies beside the middle of the warped arc. The difference between the displacements of these two points is
    // computed from the slope of the displacement. An arc at a side of the patch also belongs to the neighbouring patch, which
    // has other steps of u. For such an arc, only steps of v are used.
    const Vec3 across = now.edge[k] - now.base[k], beside = now.mapped_middle[k] - now.middle(k);
    const bool is_side = k == 0 || k == last;
    const StepsBeside steps =
        is_side ? StepsBeside(across, beside) : StepsBeside(now.middle(k + 1) - now.middle(k - 1), across, beside);
    Vec3 move = moves[k] - steps.v * (move_of_edge - move_of_base);
    if (!is_side) move = move - steps.u * (moves[k + 1] - moves[k - 1]);
    rest[k] = 2 * (move - 0.5 * (move_of_base + move_of_edge)) - (now.offset[k] - before.offset[k]);
  }
  return {nodes, rest};
}

RestInside::RestInside(const MovedPatch &moved, const PatchMaterial &material) {
  if (material.has_arcs || !has_points_inside(moved) || moved.now.mapped_inside[moved.patch].of_arcs) return;
  is_warped_ = true;
  const Patch &patch = moved.now.patches[moved.patch], &patch_before = moved.before.patches[moved.patch];
  std::array<std::array<double, n_material>, 4> nodes{};
  OfSides points{}, moves{};
  const auto add = [&](std::size_t number, Side Patch::*side, const SideMaterial &of_side) {
    nodes[number] = of_side.nodes();
    const PointsOfSide now(moved.now, patch.*side), before(moved.before, patch_before.*side);
    for (std::size_t k = 0; k < n_material; ++k)
      points[number][k] = now.point(k), moves[number][k] = now.mapped(k) - before.mapped(k);
  };
  add(0, &Patch::v0, material.v0), add(1, &Patch::v1, material.v1);
  add(2, &Patch::u0, material.u0), add(3, &Patch::u1, material.u1);
  const AtShares point(nodes, points), move(nodes, moves);
  const auto &mapped = moved.now.mapped_inside[moved.patch].points;
  const auto &mapped_before = moved.before.mapped_inside[moved.patch].points;
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    constexpr std::size_t third = (n_material - 1) / 3;
    const std::size_t at_u = (1 + i % 2) * third, at_v = (1 + i / 2) * third;
    // The mapped point lies beside the warped patch's point (u, v). The displacement at (u, v) is computed from the displacement
    // of the mapped point and from the slope of the displacement.
    const StepsBeside steps(point.along_u(at_u, at_v), point.along_v(at_u, at_v),
                            mapped[i] - point.combined(at_u, at_v));
    rest_[i] = mapped[i] - mapped_before[i] - steps.u * move.along_u(at_u, at_v) - steps.v * move.along_v(at_u, at_v) -
               move.combined(at_u, at_v);
  }
}

PatchMaterial::PatchMaterial(const MovedPatch &moved)
    // A patch of arcs whose bulge is 0 in both states equals the Coons patch of its sides at the same (u, v). Only a patch with a
    // bulge in one of the states is therefore treated as a patch of arcs.
    : has_arcs(moved.now.patches[moved.patch].bulge != 0 || moved.before.patches[moved.patch].bulge != 0),
      v0(moved, &Patch::v0),
      v1(moved, &Patch::v1) {
  if (!has_arcs) u0 = {moved, &Patch::u0}, u1 = {moved, &Patch::u1};
}

namespace {

// A side of a patch in both states.
class MovedSide {
 public:
  MovedSide(const MovedPatch &moved, Side Patch::*side, const SideMaterial &material)
      : now_(moved.now.patches[moved.patch].*side),
        before_(moved.before.patches[moved.patch].*side),
        curve_now_(moved.now.curves[now_.curve]),
        curve_before_(moved.before.curves[before_.curve]),
        material_(material),
        is_at_rest_(now_.reversed == before_.reversed && are_equal(curve_now_, curve_before_)) {}

  bool is_at_rest() const { return is_at_rest_; }

  // Returns the displacements at the given shares of the length. The shares ascend from 0 to 1. `points` has the current points,
  // if they are already known. `unknown` lists the indices of the points that are not known, in ascending order. If any point is
  // unknown, the list also contains the first and the last index.
  Vector<Vec3> displacements(const Vector<double> &shares, Vector<Vec3> points,
                             const Vector<std::size_t> &unknown) const {
    if (!unknown.empty()) {
      Vector<double> shares_unknown;
      shares_unknown.reserve(unknown.size());
      for (const std::size_t i : unknown) shares_unknown.push_back(shares[i]);
      const CurvePoints now = points_now(shares_unknown);
      for (std::size_t k = 0; k < unknown.size(); ++k) points[unknown[k]] = now.point(k);
    }
    const Vector<double> slid = material_.is_warped() ? material_.shares_before(shares) : Vector<double>{};
    const CurvePoints before = points_before(material_.is_warped() ? slid : shares);
    for (std::size_t i = 0; i < shares.size(); ++i) points[i] = points[i] - before.point(i);
    if (material_.is_warped())
      for (std::size_t i = 0; i < shares.size(); ++i) points[i] = points[i] + material_.rest(shares[i]);
    return points;
  }

  const SideMaterial &material() const { return material_; }

  CurvePoints points_now(const Vector<double> &shares) const { return {curve_now_, now_.reversed, shares}; }
  CurvePoints points_before(const Vector<double> &shares) const { return {curve_before_, before_.reversed, shares}; }

 private:
  Side now_, before_;
  const Curve &curve_now_, &curve_before_;
  const SideMaterial &material_;
  bool is_at_rest_;
};

// The lines of a grid in one direction, with additional lines between them. The space between two lines is halved as often as the
// quads there are halved.
class HalvedLines {
 public:
  HalvedLines(const Vector<GridLine> &lines, const Vector<int> &levels) : lines_(lines) {
    place_.reserve(lines.size());
    place_.push_back(0);
    for (const int level : levels) place_.push_back(place_.back() + (std::size_t{1} << level));
    middle_ = shares(&GridLine::middle);
  }

  std::size_t size() const { return place_.back() + 1; }
  // Returns the position of each line of the grid among all lines.
  const Vector<std::size_t> &places() const { return place_; }
  const Vector<GridLine> &lines() const { return lines_; }
  const Vector<double> &middle() const { return middle_; }

  Vector<double> shares(double GridLine::*t) const {
    Vector<double> made;
    made.reserve(size());
    for (std::size_t i = 0; i + 1 < lines_.size(); ++i) {
      const std::size_t n_parts = place_[i + 1] - place_[i];
      const double from = lines_[i].*t, to = lines_[i + 1].*t;
      made.push_back(from);
      for (std::size_t k = 1; k < n_parts; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(n_parts);
        made.push_back((1 - share) * from + share * to);
      }
    }
    made.push_back(lines_.back().*t);
    return made;
  }

 private:
  const Vector<GridLine> &lines_;
  Vector<std::size_t> place_;
  Vector<double> middle_;
};

// A side of a patch, and the places of its points in the grid.
struct SideOnGrid {
  Side Patch::*side;
  const SideMaterial &material;
  double GridLine::*t;
  bool GridLine::*is_vertex;
  const Vec3 *first;  // the first point in the grid; the others follow at distances of `stride`
  std::size_t stride;
};

Vector<Vec3> displacements_of(const MovedPatch &moved, const SideOnGrid &on, const HalvedLines &lines) {
  const MovedSide side(moved, on.side, on.material);
  Vector<Vec3> points(lines.size(), Vec3{0, 0, 0});
  if (side.is_at_rest()) return points;
  // Where a line ends at a vertex of the polyline, its point on the curve is already known.
  Vector<std::size_t> unknown;
  const Vector<std::size_t> &places = lines.places();
  bool has_unknown = false;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (k > 0)
      for (std::size_t i = places[k - 1] + 1; i < places[k]; ++i) has_unknown = true, unknown.push_back(i);
    points[places[k]] = on.first[k * on.stride];
    const bool is_end = k == 0 || k + 1 == places.size(), is_known = lines.lines()[k].*on.is_vertex;
    has_unknown = has_unknown || !is_known;
    if (is_end || !is_known) unknown.push_back(places[k]);
  }
  if (!has_unknown) unknown.clear();
  return side.displacements(lines.shares(on.t), std::move(points), unknown);
}

Vector<Vec3> offset_displacements(const MovedPatch &moved, const PatchMaterial &material, const Vector<double> &u) {
  const Patch &patch_now = moved.now.patches[moved.patch], &patch_before = moved.before.patches[moved.patch];
  const MovedSide base(moved, &Patch::v0, material.v0), edge(moved, &Patch::v1, material.v1);
  if (base.is_at_rest() && edge.is_at_rest() && patch_now.bulge == patch_before.bulge)
    return Vector<Vec3>(u.size(), Vec3{0, 0, 0});
  Vector<Vec3> made = arc_offsets(moved.now, patch_now, base.points_now(u), edge.points_now(u));
  const bool is_warped = base.material().is_warped() && edge.material().is_warped();
  const Vector<double> on_base = is_warped ? base.material().shares_before(u) : Vector<double>{},
                       on_edge = is_warped ? edge.material().shares_before(u) : Vector<double>{};
  const Vector<Vec3> before = arc_offsets(moved.before, patch_before, base.points_before(is_warped ? on_base : u),
                                          edge.points_before(is_warped ? on_edge : u));
  for (std::size_t i = 0; i < made.size(); ++i) made[i] = made[i] - before[i];
  if (!is_warped) return made;
  const Through<Vec3> rest = rest_of_offsets(moved, base.material(), edge.material());
  for (std::size_t i = 0; i < made.size(); ++i) made[i] = made[i] + rest.at(u[i]);
  return made;
}

}  // namespace

PatchDisplacement::PatchDisplacement(const MovedPatch &moved, const LevelledGrid &levelled)
    : column_levels_(levelled.grid.u.size() - 1, 0), row_levels_(levelled.grid.v.size() - 1, 0), levelled_(levelled) {
  auto level = levelled.levels.begin();
  for_each_quad(levelled.grid, [&](std::size_t i, std::size_t j) {
    column_levels_[i] = std::max(column_levels_[i], *level);
    row_levels_[j] = std::max(row_levels_[j], *level++);
  });
  const PatchMaterial material(moved);
  const QuadGrid &grid = levelled.grid;
  HalvedLines u_lines(grid.lines.u, column_levels_), v_lines(grid.lines.v, row_levels_);
  const std::size_t n_u = grid.u.size();
  const Vec3 *const first = grid.points.data(), *const last = first + grid.points.size();
  sides_.v0 =
      displacements_of(moved, {&Patch::v0, material.v0, &GridLine::t0, &GridLine::is_vertex0, first, 1}, u_lines);
  sides_.v1 =
      displacements_of(moved, {&Patch::v1, material.v1, &GridLine::t1, &GridLine::is_vertex1, last - n_u, 1}, u_lines);
  has_arcs_ = material.has_arcs;
  if (has_arcs_) {
    offsets_ = offset_displacements(moved, material, u_lines.middle());
  } else {
    rest_ = RestInside(moved, material);
    sides_.u0 =
        displacements_of(moved, {&Patch::u0, material.u0, &GridLine::t0, &GridLine::is_vertex0, first, n_u}, v_lines);
    sides_.u1 = displacements_of(
        moved, {&Patch::u1, material.u1, &GridLine::t1, &GridLine::is_vertex1, first + n_u - 1, n_u}, v_lines);
  }
  column_ = u_lines.places(), row_ = v_lines.places();
  u_ = u_lines.middle(), v_ = v_lines.middle();
}

Vec3 PatchDisplacement::without_jumps(std::size_t i, std::size_t j, int column, int row) const {
  const std::size_t n_columns = column_levels_.size(), n_rows = row_levels_.size();
  const int level = levelled_.levels[j * n_columns + i], n = 1 << level;
  const auto level_beside = [&](bool is_inside, std::size_t column_beside, std::size_t row_beside) {
    return is_inside ? std::min(level, levelled_.levels[row_beside * n_columns + column_beside]) : level;
  };
  if ((row == 0 || row == n) && column != 0 && column != n) {
    const int step = 1 << (level - (row == 0 ? level_beside(j > 0, i, j - 1) : level_beside(j + 1 < n_rows, i, j + 1)));
    const int from = column / step * step;
    if (from != column)
      return mix(in_quad(i, j, level, from, row), in_quad(i, j, level, from + step, row),
                 static_cast<double>(column - from) / step);
  }
  if ((column == 0 || column == n) && row != 0 && row != n) {
    const int step =
        1 << (level - (column == 0 ? level_beside(i > 0, i - 1, j) : level_beside(i + 1 < n_columns, i + 1, j)));
    const int from = row / step * step;
    if (from != row)
      return mix(in_quad(i, j, level, column, from), in_quad(i, j, level, column, from + step),
                 static_cast<double>(row - from) / step);
  }
  return in_quad(i, j, level, column, row);
}

Vec3 PatchDisplacement::at(std::size_t i, std::size_t j) const {
  const double u = u_[i], v = v_[j];
  if (has_arcs_) return mix(sides_.v0[i], sides_.v1[i], v) + (2 * v * (1 - v)) * offsets_[i];
  if (j == 0) return sides_.v0[i];
  if (j + 1 == v_.size()) return sides_.v1[i];
  if (i == 0) return sides_.u0[j];
  if (i + 1 == u_.size()) return sides_.u1[j];
  const Vec3 of_sides =
      mix(sides_.v0[i], sides_.v1[i], v) + mix(sides_.u0[j], sides_.u1[j], u) -
      mix(mix(sides_.v0.front(), sides_.v0.back(), u), mix(sides_.v1.front(), sides_.v1.back(), u), v);
  return rest_.is_warped() ? of_sides + rest_.at(u, v) : of_sides;
}

ImageVelocity::AffineMap ImageVelocity::map_of(const PatchImage &image, const Placement &placement) {
  const PatchImage turn = turn_of(image);
  const auto column = [&](Vec3 unit) { return placement.scale * (placement.rotation * place(turn, unit)); };
  const Vec3 x = column({1, 0, 0}), y = column({0, 1, 0}), z = column({0, 0, 1});
  return {{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}, place(placement, image.translation)};
}

ImageVelocity::ImageVelocity(const PatchImage &now, const PatchImage &before, const Placement &placement_now,
                             const EarlierState &earlier)
    : now_(map_of(now, placement_now)), difference_(now_), seconds_(earlier.seconds) {
  const AffineMap then = map_of(before, earlier.placement_before);
  difference_.linear.row_x = now_.linear.row_x - then.linear.row_x;
  difference_.linear.row_y = now_.linear.row_y - then.linear.row_y;
  difference_.linear.row_z = now_.linear.row_z - then.linear.row_z;
  difference_.offset = now_.offset - then.offset;
}

Vector<double> joints_of(const PatchSet &set, const Side &side) {
  Vector<double> joints = set.curve_of(side).joints();
  if (!side.reversed) return joints;
  std::reverse(joints.begin(), joints.end());
  for (double &joint : joints) joint = 1 - joint;
  return joints;
}

Vector<double> moved_with_joints(const Vector<double> &lines, const Vector<double> &from, const Vector<double> &to) {
  Vector<double> made = lines;
  if (from.empty() || from.size() != to.size()) return made;
  std::size_t k = 0;
  for (double &u : made) {
    while (k < from.size() && u >= from[k]) ++k;
    const double a = k == 0 ? 0 : from[k - 1], b = k == from.size() ? 1 : from[k];
    const double a_now = k == 0 ? 0 : to[k - 1], b_now = k == from.size() ? 1 : to[k];
    u = u == a ? a_now : u == 1 ? 1 : a_now + (u - a) / (b - a) * (b_now - a_now);
  }
  return made;
}

namespace {

Vector<std::int32_t> ids_of(const PatchSet &set) {
  Vector<std::int32_t> ids;
  for (const Patch &patch : set.patches)
    for (const PatchImage &image : patch.images) ids.push_back(image.patch_id);
  return ids;
}

}  // namespace

bool have_same_build(const PatchSet &now, const PatchSet &before) {
  const auto are_alike = [](const PatchImage &a, const PatchImage &b) {
    return a.mirror == b.mirror && a.patch_id == b.patch_id;
  };
  return std::equal(now.patches.begin(), now.patches.end(), before.patches.begin(), before.patches.end(),
                    [&](const Patch &a, const Patch &b) {
                      return std::equal(a.images.begin(), a.images.end(), b.images.begin(), b.images.end(), are_alike);
                    });
}

PatchSet with_own_patches(const PatchSet &state, const PatchSet &like) {
  PatchSet made = state;
  made.seams.clear();  // the other state may lack the seams, which change only the last bits
  // In a warped valve, each image already has a patch of its own.
  if (state.material.empty()) made = without_images(made);
  const Vector<std::int32_t> ids = ids_of(made);
  Vector<Patch> patches;
  Vector<MappedInside> inside;
  for (const std::int32_t id : ids_of(like)) {
    const auto at = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
    patches.push_back(made.patches[at]);
    if (at < made.mapped_inside.size()) inside.push_back(made.mapped_inside[at]);
  }
  made.patches = std::move(patches);
  made.mapped_inside = std::move(inside);
  return made;
}

void check_same_build(const PatchSet &now, const PatchSet &before) {
  if (!have_same_build(now, before))
    fail(RIIS_INVALID_PARAMETER,
         "the two states have different patches or different mirror images: both states must belong to one valve");
}

void check_same_ids(const PatchSet &now, const PatchSet &before, const StateNames &names) {
  if (have_same_build(now, before)) return;
  Vector<std::int32_t> ids = ids_of(now), ids_before = ids_of(before);
  if (ids.size() != ids_before.size())
    fail(RIIS_INVALID_PARAMETER, names.state, " has ", ids_before.size(), " patches, ", names.of, " has ", ids.size(),
         ": they must be two states of one valve");
  std::sort(ids.begin(), ids.end());
  std::sort(ids_before.begin(), ids_before.end());
  const auto [here, there] = std::mismatch(ids.begin(), ids.end(), ids_before.begin());
  if (here != ids.end())
    fail(RIIS_INVALID_PARAMETER, names.state, " has no patch ", *here, " as ", names.of,
         " has: they must be two states of one valve");
}

}  // namespace riis
