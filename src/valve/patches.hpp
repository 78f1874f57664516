// SPDX-License-Identifier: Apache-2.0
// What a valve hands on to the surface: curves, and patches that share them by position.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/bezier.hpp"
#include "geometry/placement.hpp"

namespace riis {

// Where a patch is put: mirrored in y or not, then turned, then moved. The same patch is put at several places by the same
// operations on the same points, so a patch and its mirror image meet in the mirror's plane to the last bit.
struct PatchImage {
  bool mirrored;
  Rotation rotation;
  Vec3 translation;
  std::int32_t leaflet_id;
  std::int32_t patch_id;
};

inline Vec3 place(const PatchImage &image, Vec3 p) {
  return image.rotation * Vec3{p.x, image.mirrored ? -p.y : p.y, p.z} + image.translation;
}

// A Coons patch by the positions of its four sides in PatchSet::curves. A curve that two patches share appears once, so
// that it becomes one polyline and the patches meet without cracks. S_u x S_v points downstream; mirror images are turned
// over to keep it so.
struct Patch {
  std::size_t side_v0, side_v1, side_u0, side_u1;
  std::vector<PatchImage> images;
};

struct PatchSet {
  std::vector<Bezier> curves;
  std::vector<Patch> patches;
};

}  // namespace riis
