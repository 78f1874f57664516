// SPDX-License-Identifier: Apache-2.0
// Tests and benchmarks compare every search with this loop over all triangles, which uses the library's decision kernel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "geometry/point_triangle.hpp"
#include "triangulate/triangle_set.hpp"

namespace riis {

// Returns the lowest position among the closest triangles of the set, and the square of their distance.
inline ClosestTriangle closest_by_brute_force(const TriangleSet &set, Vec3 p) {
  ClosestTriangle best{std::numeric_limits<double>::infinity(), -1};
  for (std::int64_t i = 0; i < set.n_triangles(); ++i) {
    const auto [a, b, c] = set.corners(i);
    const double distance_sq = closest_point_on_triangle(p, a, b, c).distance_sq;
    // Positions ascend, so the loop finds the lowest of several equally near triangles.
    if (distance_sq < best.distance_sq) best = {distance_sq, i};
  }
  return best;
}

}  // namespace riis
