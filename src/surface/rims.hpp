// SPDX-License-Identifier: Apache-2.0
// The rim of a valve: the sides of its patches that neither another patch nor an image shares.
// In: patches; an edge of a triangle. Out: the sides on the rim, and whether the edge lies on one of them.
#pragma once

#include <cstdint>

#include "base/recycled.hpp"
#include "surface/triangle_set.hpp"
#include "valve/patches.hpp"

namespace riis {

// Bits of TriangleSet::rim_sides.
enum PatchRim : std::uint8_t { rim_v0 = 1, rim_v1 = 2, rim_u0 = 4, rim_u1 = 8 };

// Returns the sides on the rim for each patch_id. Two patches share a side if it is the same curve and their images have the
// same place. A patch shares a side with its own mirror image if the curve lies in the mirror's plane. It shares a side with
// itself if two of its sides are one curve. Images also share the sides at which they are sewn together (Seam). Patches may also
// meet inside a side, as along the bending curve. Nothing depends on vertices there, so a T-junction is no rim.
Vector<std::uint8_t> rim_sides(const PatchSet &set);

// Returns whether edge k, from corner k to the next, of a triangle lies on a side on the rim.
bool is_on_rim_side(const TriangleSet &set, std::int64_t triangle, std::int64_t k);

}  // namespace riis
