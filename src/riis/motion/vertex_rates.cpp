// SPDX-License-Identifier: Apache-2.0
#include "motion/vertex_rates.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "common/array_view.hpp"
#include "geometry/curve.hpp"
#include "motion/displacement.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// The joints of base and edge of a patch of arcs, in the surface's state and in another state. If two joints are equal, the joint
// of the base comes first, as in Bulge::joints.
class MovedJoints {
 public:
  MovedJoints(const PatchSet &at, const PatchSet &state, std::size_t patch) {
    for (const auto side : {&Patch::v0, &Patch::v1}) {
      const Vector<double> from = along(at, at.patches[patch].*side).joints(),
                           to = along(state, state.patches[patch].*side).joints();
      if (from.size() != to.size()) continue;  // joints that were left out do not move
      for (std::size_t k = 0; k < from.size(); ++k) joints_.push_back({from[k], to[k]});
    }
    std::stable_sort(joints_.begin(), joints_.end(), [](const Joint &a, const Joint &b) { return a.from < b.from; });
  }

  // The range between two lines is cut by a further line. This line lies at a joint that is far enough from both ends, or
  // otherwise in the middle. Returns where the line lies in the other state.
  double cut(double from, double to, double moved_from, double moved_to) const {
    for (const Joint &joint : joints_)
      if (joint.from > 0.875 * from + 0.125 * to && joint.from < 0.125 * from + 0.875 * to) return joint.to;
    return 0.5 * (moved_from + moved_to);
  }
  double cut(double from, double to) const {
    for (const Joint &joint : joints_)
      if (joint.from > 0.875 * from + 0.125 * to && joint.from < 0.125 * from + 0.875 * to) return joint.from;
    return 0.5 * (from + to);
  }
  bool is_empty() const { return joints_.empty(); }

 private:
  struct Joint {
    double from, to;
  };
  Vector<Joint> joints_;
};

// An adapted grid of arcs has lines at the vertices of its curves, and further lines, the cuts, between them. This class moves
// the cuts.
class MovedCuts {
 public:
  MovedCuts(const MovedJoints &joints, const Vector<GridLine> &from, Vector<GridLine> &to)
      : joints_(joints), from_(from), to_(to) {}

  void move_between(std::size_t first, std::size_t last) {
    if (last - first < 2) return;
    const double u = joints_.cut(from_[first].middle, from_[last].middle);
    std::size_t at = first + 1;
    while (at < last && from_[at].middle != u) ++at;
    if (at == last) return;
    const double moved = joints_.cut(from_[first].middle, from_[last].middle, to_[first].middle, to_[last].middle);
    to_[at].t0 = to_[at].t1 = to_[at].middle = moved;
    move_between(first, at);
    move_between(at, last);
  }

 private:
  const MovedJoints &joints_;
  const Vector<GridLine> &from_;
  Vector<GridLine> &to_;
};

// Returns the lines u of a grid in another state. Lines move only if the grid's move_with_joints is true.
Vector<GridLine> lines_in(const PatchSet &at, const PatchSet &state, std::size_t patch, const GridLines &lines) {
  Vector<GridLine> made = lines.u;
  if (lines.move_with_joints) {
    // The side v1 of a skirt's strip beside a patch of arcs is also the base of that patch. The strip's lines move with this
    // base.
    const auto side = at.patches[patch].skirt_of_arcs != no_patch ? &Patch::v1 : &Patch::v0;
    const Vector<double> moved = moved_with_joints(middles(made), joints_of(at, at.patches[patch].*side),
                                                   joints_of(state, state.patches[patch].*side));
    for (std::size_t k = 0; k < made.size(); ++k) made[k].t0 = made[k].t1 = made[k].middle = moved[k];
    return made;
  }
  if (at.patches[patch].bulge == 0) return made;
  const MovedJoints joints(at, state, patch);
  if (joints.is_empty()) return made;
  MovedCuts cuts(joints, lines.u, made);
  std::size_t last = 0;
  for (std::size_t k = 1; k < made.size(); ++k) {
    if (!made[k].is_vertex0 && !made[k].is_vertex1) continue;
    cuts.move_between(last, k);
    last = k;
  }
  return made;
}

// Returns the points of a side at which lines end. Such a point lies on the curve at a vertex of the side, and elsewhere on a
// chord.
Vector<Vec3> points_along(const PatchSet &state, const Side &side, const Vector<GridLine> &lines, double GridLine::*t,
                          bool GridLine::*is_vertex) {
  Vector<double> shares;
  Vector<std::size_t> vertices;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (k > 0 && k + 1 < lines.size() && !(lines[k].*is_vertex)) continue;
    shares.push_back(lines[k].*t);
    vertices.push_back(k);
  }
  const CurvePoints on_curve(state.curve_of(side), side.reversed, shares);
  Vector<Vec3> made(lines.size());
  made.front() = on_curve.point(0);
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const std::size_t from = vertices[i - 1], to = vertices[i];
    made[to] = on_curve.point(i);
    for (std::size_t k = from + 1; k < to; ++k)
      made[k] = mix(made[from], made[to], (lines[k].*t - lines[from].*t) / (lines[to].*t - lines[from].*t));
  }
  return made;
}

struct PatchStates {
  const PatchSet &at, &after, &before;
  std::size_t patch;

  // A patch of arcs whose bulge is 0 in all states equals the Coons patch of its sides at the same (u, v).
  bool has_arcs() const {
    return at.patches[patch].bulge != 0 || after.patches[patch].bulge != 0 || before.patches[patch].bulge != 0;
  }
};

Vector<Vec3> grid_points(const PatchStates &states, const PatchSet &state, const QuadGrid &grid) {
  const Patch &patch = state.patches[states.patch];
  const Vector<GridLine> u_lines = lines_in(states.at, state, states.patch, grid.lines);
  SideVectors sides;
  sides.v0 = points_along(state, patch.v0, u_lines, &GridLine::t0, &GridLine::is_vertex0);
  sides.v1 = points_along(state, patch.v1, u_lines, &GridLine::t1, &GridLine::is_vertex1);
  if (!states.has_arcs()) {
    sides.u0 = points_along(state, patch.u0, grid.lines.v, &GridLine::t0, &GridLine::is_vertex0);
    sides.u1 = points_along(state, patch.u1, grid.lines.v, &GridLine::t1, &GridLine::is_vertex1);
    return coons_combination(grid.u, grid.v, sides);
  }
  const Vector<double> u = middles(u_lines);
  const Vector<Vec3> offsets = arc_offsets(state, patch, {state.curve_of(patch.v0), patch.v0.reversed, u},
                                           {state.curve_of(patch.v1), patch.v1.reversed, u});
  Vector<Vec3> made;
  made.reserve(u.size() * grid.v.size());
  for (const double v : grid.v)
    for (std::size_t i = 0; i < u.size(); ++i)
      made.push_back(mix(sides.v0[i], sides.v1[i], v) + (2 * v * (1 - v)) * offsets[i]);
  return made;
}

// Returns the points of a grid in a state, followed by the points of its subdivided quads (vertices_of in triangulate/tiles.cpp).
Vector<Vec3> points_in(const PatchStates &states, const PatchSet &state, const LevelledGrid &levelled) {
  const QuadGrid &grid = levelled.grid;
  const QuadGrid moved{grid.u, grid.v, grid_points(states, state, grid), {}};
  Vector<Vec3> made = moved.points;
  made.reserve(static_cast<std::size_t>(levelled.n_vertices));
  auto level = levelled.levels.begin();
  for_each_quad(moved, [&](std::size_t i, std::size_t j) {
    const int n_parts = 1 << *level++;
    if (n_parts == 1) return;
    const Quad quad = quad_of(moved, i, j);
    for (int row = 0; row <= n_parts; ++row)
      for (int column = 0; column <= n_parts; ++column)
        made.push_back(quad.at(static_cast<double>(column) / n_parts, static_cast<double>(row) / n_parts));
  });
  return made;
}

// Writes the rates of the vertices of all images of one patch.
void write_rates(const PatchStates &states, const LevelledGrid &levelled, const Direction &direction, double *rates) {
  const bool is_one_state = &states.after == &states.before;
  const Vector<Vec3> after = points_in(states, states.after, levelled);
  const Vector<Vec3> before = is_one_state ? Vector<Vec3>{} : points_in(states, states.before, levelled);
  const EarlierState earlier{states.before, direction.placement_before, direction.step};
  const std::size_t n_images = states.at.patches[states.patch].images.size();
  for (std::size_t image = 0; image < n_images; ++image) {
    const ImageVelocity moved(states.after.patches[states.patch].images[image],
                              states.before.patches[states.patch].images[image], direction.placement_after, earlier);
    for (std::size_t i = 0; i < after.size(); ++i) {
      const Vec3 displacement = is_one_state ? Vec3{0, 0, 0} : after[i] - before[i];
      put_vector(rates, static_cast<std::int64_t>(image * after.size() + i), moved.velocity(after[i], displacement));
    }
  }
}

}  // namespace

void make_vertex_rates(const PatchSet &at, const Vector<LevelledGrid> &grids, const Direction &direction, int n_threads,
                       std::vector<double> &rates) {
  if (!have_same_build(at, direction.after) || !have_same_build(at, direction.before)) {
    const bool is_one_state = &direction.after == &direction.before;
    const PatchSet own = with_own_patches(at, at), after = with_own_patches(direction.after, at);
    const PatchSet before = is_one_state ? PatchSet{} : with_own_patches(direction.before, at);
    Vector<LevelledGrid> own_grids;
    for (std::size_t i = 0; i < grids.size(); ++i)
      own_grids.insert(own_grids.end(), at.patches[i].images.size(), grids[i]);
    return make_vertex_rates(
        own, own_grids,
        {after, is_one_state ? after : before, direction.placement_after, direction.placement_before, direction.step},
        n_threads, rates);
  }
  Vector<std::int64_t> first;
  std::int64_t n_vertices = 0;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    first.push_back(n_vertices);
    n_vertices += view(at.patches[i].images).size() * grids[i].n_vertices;
  }
  resize(rates, 3 * n_vertices);
  parallel_for(view(grids).size(), n_threads, [&](std::int64_t i, int) {
    write_rates({at, direction.after, direction.before, static_cast<std::size_t>(i)}, view(grids)[i], direction,
                rates.data() + 3 * view(first)[i]);
  });
}

}  // namespace riis
