// SPDX-License-Identifier: Apache-2.0
// The rim of a valve: the sides of its patches that neither another patch nor an image shares.
// In: patches; an edge of a triangle. Out: the sides on the rim, and whether the edge lies on one of them.
#pragma once

#include <cstdint>

#include "base/recycled.hpp"
#include "surface/triangle_set.hpp"
#include "valve/patches.hpp"

namespace riis {

// Bits of TriangleSet::rim_sides. The last one is for a side v1 that no other patch of the same leaflet has. It is a part of the
// leaflet's free edge, also where closed leaflets meet in it.
enum PatchRim : std::uint8_t { rim_v0 = 1, rim_v1 = 2, rim_u0 = 4, rim_u1 = 8, free_v1 = 16 };

// Returns the sides on the rim for each patch_id. Two patches share a side if it is the same curve and their images have the
// same place. A patch shares a side with its own mirror image if the curve lies in the mirror's plane. It shares a side with
// itself if two of its sides are one curve. Images also share the sides at which they are sewn together (Seam). Patches may also
// meet inside a side, as along the bending curve. Nothing depends on vertices there, so a T-junction is no rim.
Vector<std::uint8_t> rim_sides(const PatchSet &set);

// Returns the sides of its patch that a vertex lies on, by its u and v. A vertex on a side has the side's parameter exactly. An
// edge lies on a side if both ends do.
inline std::uint8_t sides_of_place(const double *uv) {
  return static_cast<std::uint8_t>((uv[1] == 0 ? rim_v0 : 0) | (uv[1] == 1 ? rim_v1 : 0) | (uv[0] == 0 ? rim_u0 : 0) |
                                   (uv[0] == 1 ? rim_u1 : 0));
}

}  // namespace riis
