// SPDX-License-Identifier: Apache-2.0
// The decision kernel finds the point of one triangle closest to a given point, in double precision. Every mark and every
// reported distance comes from this function. This function is compiled once, for the baseline instruction set and without
// contraction. Every caller thus gets the same bits.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/vec3.hpp"

namespace riis {

struct PointOnTriangle {
  double distance_sq;
  Vec3 point;
  std::array<double, 3> barycentric;  // >= 0; for a point on an edge or a vertex, exactly 0 for the other corners
};

// The triangle must have an area (has_zero_area in triangulate/triangle_set.hpp). The result is the best of three or four
// candidates. Three are the closest points of the edges. The fourth is the foot of the perpendicular, if this foot is inside. Up
// to rounding, each candidate lies on the triangle. A wrong decision about "inside" therefore adds only a rounding error, and the
// distance never becomes too small.
PointOnTriangle closest_point_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c);

// The closest of several triangles. Among triangles at the same distance, the triangle with the lowest position counts as the
// closest.
struct ClosestTriangle {
  double distance_sq;
  std::int64_t triangle;  // position in the set, -1 for none
};

inline bool is_closer(double distance_sq, std::int64_t triangle, const ClosestTriangle &best) {
  return distance_sq < best.distance_sq || (distance_sq == best.distance_sq && triangle < best.triangle);
}

}  // namespace riis
