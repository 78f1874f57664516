// SPDX-License-Identifier: Apache-2.0
// Decides exactly whether a segment and a triangle have a point in common, for coordinates in double precision.
#pragma once

#include <array>

#include "geometry/vec3.hpp"

namespace riis {

// Coordinates of a smaller magnitude count as 0, because their products would leave the range of doubles.
inline constexpr double negligible_coordinate = 1e-90;

// Returns whether the closed segment from a to b and the closed triangle have a point in common. Coordinates must be at most
// max_coordinate in magnitude, and the triangle must have an area (has_zero_area). The answer is exact, without a tolerance or
// rounding. A segment through the common edge of two triangles meets both. The order of the ends and of the corners does not
// matter.
bool segment_meets_triangle(Vec3 a, Vec3 b, const std::array<Vec3, 3> &corners);

}  // namespace riis
