// SPDX-License-Identifier: Apache-2.0
// The caller's points, borrowed as three pointers and a stride, and the checks of their coordinates.
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

// Distances need fourth powers. Coordinates up to the first number and edges from the second one on keep them within doubles.
inline constexpr double max_coordinate = 1e60, min_edge = 1e-60;

// Returns whether coordinates are finite and not too large; false for NaN.
inline bool is_usable(double coordinate) { return std::abs(coordinate) <= max_coordinate; }
inline bool is_usable(Vec3 p) { return is_usable(p.x) && is_usable(p.y) && is_usable(p.z); }

// Checks pointers, stride and every coordinate. Only the calling thread runs: others would not pay, and the caller may not want
// them. Fails with RIIS_INVALID_ARGUMENT, or with bad_coordinate for the first unusable coordinate. The message then names the
// point by `what` ("node", "point") and its number. Returns the points' box, which the same pass over memory finds.
Bounds check_points(const StridedPoints &points, const char *what, riis_status bad_coordinate);

// Checks one point, as check_points checks all.
void check_point(const StridedPoints &points, std::int64_t i, const char *what, riis_status bad_coordinate);

// Returns point i of points that were checked when they were given. The caller may have written to them since: the call fails
// as check_points does.
inline Vec3 checked_point(const StridedPoints &points, std::int64_t i, const char *what, riis_status bad_coordinate) {
  const Vec3 p = points[i];
  if (!is_usable(p)) check_points(points, what, bad_coordinate);
  return p;
}

}  // namespace riis
