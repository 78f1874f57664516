// SPDX-License-Identifier: Apache-2.0
// How deep two triangles are in each other, and the segment that they have in common.
// In: two triangles with an area, coordinates up to 1e60. Out: the penetration depth, the segment's middle and length.
#pragma once

#include <array>

#include "geometry/vec3.hpp"

namespace riis {

using Triangle = std::array<Vec3, 3>;

// Returns the length of the shortest translation of one triangle after which both only touch, or 0 if that is at most `limit`.
// Triangles that touch or lie in a plane have depth 0. The result is right to 2^-24 of the longest edge and 2^-48 of the largest
// coordinate (docs/theory.md, section 16).
double penetration_depth(const Triangle &a, const Triangle &b, double limit);

struct CommonSegment {
  Vec3 middle;
  double length;
};

// Both triangles have a depth beyond that error.
CommonSegment common_segment(const Triangle &a, const Triangle &b);

}  // namespace riis
