// SPDX-License-Identifier: Apache-2.0
#include "geometry/quads.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "common/array_view.hpp"

namespace riis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Bounds the distance between a quad and its triangles at a level of subdivision. The function stops refining the bound as soon
// as the bound is at most `enough`.
double split_error_at(const Quad &quad, int level, double enough) {
  // Below the level `few`, all parts of the quad are checked, because their number is small. From the level `few` on, the bound
  // follows from the twist alone, which each level divides by exactly 4.
  constexpr int few = 5;
  const double at_equal_uv = std::ldexp(quad_flatness(quad), -2 * level);
  if (level >= few || (at_equal_uv <= enough && enough < infinity)) return at_equal_uv;
  const int n = 1 << level;
  double largest = 0;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const double s0 = static_cast<double>(column) / n, s1 = static_cast<double>(column + 1) / n;
      const double t0 = static_cast<double>(row) / n, t1 = static_cast<double>(row + 1) / n;
      largest = std::max(largest, split_error({quad.at(s0, t0), quad.at(s1, t0), quad.at(s1, t1), quad.at(s0, t1)}));
      if (!(largest <= enough)) return at_equal_uv;
    }
  return std::min(largest, at_equal_uv);
}

// A level of subdivision and its error. The level says how often the sides of a quad are halved, and the error bounds the
// distance from the triangles to the smooth patch.
struct Level {
  int level;
  double error;
};

// Halves a quad until its parts are close enough to their triangles. The halving ends, because each level divides the twist by 4.
Level subdivision_level(const QuadGrid &grid, std::size_t i, std::size_t j, double max_error) {
  const Quad quad = quad_of(grid, i, j);
  const double left = max_error - grid.error(i, j);
  for (int level = 0;; ++level) {
    const double error = split_error_at(quad, level, left);
    if (error <= left || level == most_halvings) return {level, grid.error(i, j) + error};
  }
}

// Returns the quad after both ends of its shortest edge have moved to the middle of this edge. No point moves by more than half
// the edge.
Quad without_shortest_edge(const Quad &quad, double &shortest) {
  std::array<Vec3, 4> corner{quad.p00, quad.p10, quad.p11, quad.p01};
  std::size_t at = 0;
  const auto edge = [&](std::size_t i) { return distance(corner[i], corner[(i + 1) % 4]); };
  for (std::size_t i = 1; i < 4; ++i) at = edge(i) < edge(at) ? i : at;
  shortest = edge(at);
  corner[at] = corner[(at + 1) % 4] = mix(corner[at], corner[(at + 1) % 4], 0.5);
  return {corner[0], corner[1], corner[2], corner[3]};
}

// Returns the quad's planned level, with the error at this level. At some openings, rounding folds a quad at a collapsed side.
// Such a fold raises the bound for the quad, but not the bound for the quad without the collapsed edge.
Level planned_level(const QuadGrid &grid, std::size_t i, std::size_t j, double max_error, int level) {
  const Quad quad = quad_of(grid, i, j);
  const double left = max_error - grid.error(i, j);
  double error = split_error_at(quad, level, left);
  if (!(error <= left)) {
    double shortest = 0;
    const Quad merged = without_shortest_edge(quad, shortest);
    // The quad and the merged quad, and also their triangles, are at most half the shortest edge apart. The whole length of the
    // edge is therefore added to the error of the merged quad.
    error = std::min(split_error_at(quad, level, infinity), split_error_at(merged, level, infinity) + shortest);
  }
  return {level, grid.error(i, j) + error};
}

LevelledGrid without_levels(QuadGrid grid) {
  LevelledGrid made{std::move(grid), {}};
  made.n_vertices = view(made.grid.u).size() * view(made.grid.v).size();
  return made;
}

// Adds a quad's triangles, additional vertices and error to the sums.
void count(const Level &level, LevelledGrid &made) {
  made.error_bound = std::max(made.error_bound, level.error);
  const std::int64_t n = std::int64_t{1} << level.level;
  made.n_triangles += 2 * n * n;
  if (n > 1) made.n_vertices += (n + 1) * (n + 1);
}

// Counts the triangles with two equal corners, in the quads at the patch's sides only. Most such triangles lie along a collapsed
// side.
void count_collapsed(LevelledGrid &made) {
  const QuadGrid &grid = made.grid;
  const std::size_t n_u = grid.u.size() - 1, n_v = grid.v.size() - 1;
  const auto equal = [](Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; };
  for (std::size_t j = 0; j < n_v; ++j)
    for (std::size_t i = 0; i < n_u; i += j == 0 || j + 1 == n_v || i + 1 == n_u ? 1 : n_u - 1) {
      if (made.levels[j * n_u + i] != 0) continue;
      const Quad quad = quad_of(grid, i, j);
      const bool is_one_point = equal(quad.p00, quad.p11);
      made.n_collapsed += is_one_point || equal(quad.p00, quad.p10) || equal(quad.p10, quad.p11);
      made.n_collapsed += is_one_point || equal(quad.p00, quad.p01) || equal(quad.p01, quad.p11);
    }
}

}  // namespace

double split_error(const Quad &q) {
  const double at_equal_uv = quad_flatness(q);
  const Vec3 normal = cross(q.p11 - q.p00, q.p01 - q.p10);
  const double size = length(normal);
  const auto turns_left = [&](Vec3 a, Vec3 b, Vec3 c) { return dot(cross(b - a, c - b), normal) >= 0; };
  const bool is_graph = size > 0 && turns_left(q.p00, q.p10, q.p11) && turns_left(q.p10, q.p11, q.p01) &&
                        turns_left(q.p11, q.p01, q.p00) && turns_left(q.p01, q.p00, q.p10);
  if (!is_graph) return at_equal_uv;
  const Vec3 twist = (q.p00 - q.p10) + (q.p11 - q.p01);
  return std::min(at_equal_uv, 0.5 * std::abs(dot(twist, normal)) / size);
}

LevelledGrid with_levels(QuadGrid grid, double max_error) {
  LevelledGrid made = without_levels(std::move(grid));
  made.levels.reserve(made.grid.errors.size());
  for_each_quad(made.grid, [&](std::size_t i, std::size_t j) {
    const Level level = subdivision_level(made.grid, i, j, max_error);
    made.levels.push_back(level.level);
    count(level, made);
  });
  count_collapsed(made);
  return made;
}

LevelledGrid with_planned_levels(QuadGrid grid, double max_error, const Vector<int> &planned) {
  LevelledGrid made = without_levels(std::move(grid));
  made.levels = planned;
  const QuadGrid &in = made.grid;
  const int *level = planned.data();
  const double *error = in.errors.data();
  const Vec3 *below = in.points.data(), *above = below + in.u.size();
  for (std::size_t j = 0; j + 1 < in.v.size(); ++j, ++below, ++above)
    for (std::size_t i = 0; i + 1 < in.u.size(); ++i, ++level, ++error, ++below, ++above) {
      // For most quads, which are not subdivided, the bound from the twist alone is small enough.
      const double at_equal_uv = *level == 0 ? quad_flatness({below[0], below[1], above[1], above[0]}) : infinity;
      count(at_equal_uv <= max_error - *error ? Level{0, *error + at_equal_uv}
                                              : planned_level(in, i, j, max_error, *level),
            made);
    }
  return made;
}

void raise_levels(const QuadGrid &grid, double max_error, Vector<int> &levels) {
  levels.resize(grid.errors.size(), 0);
  std::size_t at = 0;
  for_each_quad(grid, [&](std::size_t i, std::size_t j) {
    int &level = levels[at++];
    while (level < most_halvings && !(planned_level(grid, i, j, max_error, level).error <= max_error)) ++level;
  });
}

}  // namespace riis
