// SPDX-License-Identifier: Apache-2.0
// The decision kernel: the closest point of one triangle to one point, in double precision. Every mark and every
// reported distance comes from it, so it is compiled once, for the baseline instruction set and without contraction:
// the same bits whoever calls.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/vec3.hpp"

namespace riis {

struct PointOnTriangle {
  double distance_sq;
  Vec3 point;
  std::array<double, 3> barycentric;  // >= 0; 0 exactly for a corner that an edge or vertex does not touch
};

// The triangle has an area (has_zero_area in surface/triangle_set.hpp). The point is the best of four candidates, each
// on the triangle to rounding: on the three edges, clamped, and the foot of the perpendicular where that is inside. A
// misjudged "inside" therefore costs rounding only, never a distance that is too small.
PointOnTriangle closest_point_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c);

// Closest over several triangles: the smallest square, the lowest position among equals.
struct ClosestTriangle {
  double distance_sq;
  std::int64_t triangle;  // position in the set, -1 for none
};

inline bool is_closer(double distance_sq, std::int64_t triangle, const ClosestTriangle &best) {
  return distance_sq < best.distance_sq || (distance_sq == best.distance_sq && triangle < best.triangle);
}

}  // namespace riis
