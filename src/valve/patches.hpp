// SPDX-License-Identifier: Apache-2.0
// What a valve hands on to the surface: curves, and patches that share them by position.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/bezier.hpp"

namespace riis {

// A Coons patch by the positions of its four sides in PatchSet::curves. A curve that two patches share appears once, so
// that it becomes one polyline and the patches meet without cracks.
struct Patch {
  std::size_t side_v0, side_v1, side_u0, side_u1;
  std::int32_t leaflet_id;
  std::int32_t patch_id;
  bool flip;  // the triangles' normal is -S_u x S_v: the patch is a mirror image
};

struct PatchSet {
  std::vector<Bezier> curves;
  std::vector<Patch> patches;
};

}  // namespace riis
