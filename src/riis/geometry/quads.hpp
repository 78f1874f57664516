// SPDX-License-Identifier: Apache-2.0
// Quads of grids, and the number of halvings before quads are split into triangles (docs/theory/triangles.md). This file finds
// the level of each quad, and a bound on the error of the quad's triangles.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/recycled.hpp"
#include "geometry/coons.hpp"

namespace riis {

// A bilinear quad, given by its corners at (u,v) = (0,0), (1,0), (1,1) and (0,1). The diagonal p00 p11 splits the quad into two
// triangles.
struct Quad {
  Vec3 p00, p10, p11, p01;

  // On an edge, the result depends only on the two ends of the edge. Neighbouring quads therefore agree to the last bit on their
  // common edge.
  Vec3 at(double s, double t) const { return mix(mix(p00, p10, s), mix(p01, p11, s), t); }
};

// Returns kappa_quad, the distance between the middle of the bilinear quad and the middle of its diagonal p00 p11. This number
// bounds the distance between the quad and its two triangles at the same (u,v).
inline double quad_flatness(const Quad &quad) { return 0.25 * length((quad.p00 - quad.p10) + (quad.p11 - quad.p01)); }

// Bounds the distance between two surfaces, the bilinear quad and its two triangles. The bound is kappa_quad in general. Take a
// plane parallel to both diagonals. If the quad and the triangles are graphs over this plane, half the twist's component normal
// to the plane is a bound (docs/theory/triangles.md).
double split_error(const Quad &quad);

inline Quad quad_of(const QuadGrid &grid, std::size_t i, std::size_t j) {
  return {grid.point(i, j), grid.point(i + 1, j), grid.point(i + 1, j + 1), grid.point(i, j + 1)};
}

template <class Visit>
void for_each_quad(const QuadGrid &grid, const Visit &visit) {
  for (std::size_t j = 0; j + 1 < grid.v.size(); ++j)
    for (std::size_t i = 0; i + 1 < grid.u.size(); ++i) visit(i, j);
}

// A limit on the number of halvings. Every quad that the library accepts needs fewer halvings.
inline constexpr int most_halvings = 13;

// The quads of a patch, and their levels of subdivision in the order of for_each_quad.
struct LevelledGrid {
  QuadGrid grid;
  Vector<int> levels;
  std::int64_t n_triangles = 0;  // for one image, including triangles that turn out to have no area
  std::int64_t n_collapsed = 0;  // triangles at the sides with two equal corners, and therefore surely without area
  std::int64_t n_vertices = 0;
  double error_bound = 0;  // bounds the distance between the triangles and the smooth patch
};

// Gives each quad the lowest level at which its error is at most max_error.
LevelledGrid with_levels(QuadGrid grid, double max_error);
// Gives the quads the levels of a plan. The bounds on the errors are refined only until they are at most max_error.
LevelledGrid with_planned_levels(QuadGrid grid, double max_error, const Vector<int> &planned);

// Raises the level of each quad until its error is at most max_error. An empty list stands for levels of 0.
void raise_levels(const QuadGrid &grid, double max_error, Vector<int> &levels);

}  // namespace riis
