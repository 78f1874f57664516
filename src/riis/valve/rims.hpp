// SPDX-License-Identifier: Apache-2.0
// The rim of a valve: the sides that only one image of one patch has. An image is a turned or mirrored copy of a patch.
// This file finds the sides on the rim, and tells whether an edge of a triangle lies on the rim.
#pragma once

#include <cstdint>

#include "base/recycled.hpp"
#include "valve/patches.hpp"

namespace riis {

// Bits of an entry of TriangleSet::rim_sides. The bit free_v1 marks a side v1 that only one patch of the leaflet has. This side
// is a part of the leaflet's free edge, even if closed leaflets meet there. A skirt has no free edge. The bit `held` marks a
// patch of a leaflet whose attached side no other patch has.
enum PatchRim : std::uint8_t { rim_v0 = 1, rim_v1 = 2, rim_u0 = 4, rim_u1 = 8, free_v1 = 16, held = 32 };

// Returns, for each patch_id, the sides on the rim. Two patches share a side if both use the same curve there, and their images
// put this curve at the same position. A patch and its own mirror image share a side in the mirror's plane. If two sides of a
// patch are the same curve, the patch shares this side with itself. Images also share the sides at which they are sewn together
// (Seam). Along a common side, such as the bending curve, a patch may have vertices inside the edges of the other patch. Such
// T-junctions are not on the rim.
Vector<std::uint8_t> rim_sides(const PatchSet &set);

// Returns the sides of the patch on which a vertex with this u and v lies. A vertex on a side has exactly the side's parameter.
// An edge lies on a side if both its ends lie on the side.
inline std::uint8_t sides_of_place(const double *uv) {
  return static_cast<std::uint8_t>((uv[1] == 0 ? rim_v0 : 0) | (uv[1] == 1 ? rim_v1 : 0) | (uv[0] == 0 ? rim_u0 : 0) |
                                   (uv[0] == 1 ? rim_u1 : 0));
}

}  // namespace riis
