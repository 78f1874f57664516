// SPDX-License-Identifier: Apache-2.0
// Measures how deep two triangles penetrate each other, and finds the segment that they have in common.
// In: two triangles with an area, coordinates up to 1e60. Out: the penetration depth, the segment's middle and length.
#pragma once

#include <array>

#include "geometry/vec3.hpp"

namespace riis {

using Triangle = std::array<Vec3, 3>;

// Returns the length of the shortest translation of one triangle after which the two only touch. Returns 0 if this length is at
// most `limit`. Triangles that only touch, or that lie in one plane, have depth 0. The error is at most 2^-24 of the longest
// edge plus 2^-48 of the largest coordinate (docs/theory.md, section 16).
double penetration_depth(const Triangle &a, const Triangle &b, double limit);

struct CommonSegment {
  Vec3 middle;
  double length;
};

// Returns the segment that two triangles have in common. Their depth must exceed the error of penetration_depth.
CommonSegment common_segment(const Triangle &a, const Triangle &b);

}  // namespace riis
