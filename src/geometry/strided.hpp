// SPDX-License-Identifier: Apache-2.0
// The caller's points where they lie, three pointers and a stride, and what is demanded of their coordinates.
#pragma once

#include <riis/riis.h>

#include <cmath>
#include <cstdint>

#include "geometry/bounds.hpp"
#include "geometry/vec3.hpp"

namespace riis {

struct StridedPoints {
  std::int64_t n;
  const double *x, *y, *z;
  std::int64_t stride;

  Vec3 operator[](std::int64_t i) const { return {x[i * stride], y[i * stride], z[i * stride]}; }
  // Asks the processor for the point's coordinates, which are read soon.
  void prefetch(std::int64_t i) const {
    for (const double *coordinate : {x + i * stride, y + i * stride, z + i * stride}) __builtin_prefetch(coordinate);
  }
};

// Coordinates up to here, and edges of triangles from here, keep the fourth powers that distances need within doubles.
inline constexpr double max_coordinate = 1e60, min_edge = 1e-60;

// Finite and not too large; false for NaN.
inline bool is_usable(double coordinate) { return std::abs(coordinate) <= max_coordinate; }
inline bool is_usable(Vec3 p) { return is_usable(p.x) && is_usable(p.y) && is_usable(p.z); }

// Checks pointers, stride and every coordinate, on the calling thread: starting others would not pay, and they may not be
// wanted. Fails with RIIS_INVALID_ARGUMENT, or with bad_coordinate for the first unusable coordinate, naming its point as
// `what` ("node", "point") and number. Returns the points' box, of which the same pass over memory learns.
Bounds check_points(const StridedPoints &points, const char *what, riis_status bad_coordinate);

// Checks one point, as check_points checks all.
void check_point(const StridedPoints &points, std::int64_t i, const char *what, riis_status bad_coordinate);

// Point i of points that were checked when they were given, but that the caller may have written to since: fails in the same way.
inline Vec3 checked_point(const StridedPoints &points, std::int64_t i, const char *what, riis_status bad_coordinate) {
  const Vec3 p = points[i];
  if (!is_usable(p)) check_points(points, what, bad_coordinate);
  return p;
}

}  // namespace riis
