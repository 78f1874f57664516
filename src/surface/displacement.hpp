// SPDX-License-Identifier: Apache-2.0
// Tells how far the points of a patch moved since an earlier state of the valve (docs/theory.md, "Velocity").
// In: the patch now and before, the lines of its grid. Out: the displacement of every grid point.
#pragma once

#include "base/recycled.hpp"
#include "geometry/coons.hpp"
#include "geometry/placement.hpp"
#include "valve/patches.hpp"

namespace riis {

// The state before the triangulated one, and the time between them.
struct Motion {
  const PatchSet &patches_before;
  Placement placement_before;
  double seconds;  // not 0; negative if the valve runs backwards
};

// A patch at both states, with what its grid was made from.
struct MovedPatch {
  const PatchSet &now, &before;
  std::size_t patch;
  const PatchSides &sides;      // of the patch now
  const Vector<Vec3> *offsets;  // O on each u line now; null for a Coons patch
};

// Returns S_now(u,v) - S_before(u,v) for every point of the grid, in the order of QuadGrid::points. On their sides
// both are points of the smooth patches, and inside they are the same combination of these. The two states share only the label
// (u,v), so a change of the triangles does not matter. The result is exactly 0 where neither the sides nor the bulge changed.
Vector<Vec3> displacements(const MovedPatch &moved, const GridLines &lines);

// The motion of one image of a patch in space: that of the patch, of the image and of the placement together.
class ImageMotion {
 public:
  ImageMotion(const PatchImage &now, const PatchImage &before, const Placement &placement_now, const Motion &motion);

  // Returns the mean velocity, over the time between the states, of the point that is p now, before the image is placed, and
  // that was p - displacement. Nothing cancels where image and placement are at rest.
  Vec3 velocity(Vec3 p, Vec3 displacement) const {
    const Vec3 moved = now_.linear * displacement + difference_.linear * (p - displacement) + difference_.offset;
    return {moved.x / seconds_, moved.y / seconds_, moved.z / seconds_};
  }

 private:
  struct AffineMap {
    Rotation linear;  // of any scale, and mirrored or not
    Vec3 offset;
  };
  static AffineMap map_of(const PatchImage &image, const Placement &placement);

  AffineMap now_, difference_;
  double seconds_;
};

// Fails with RIIS_INVALID_PARAMETER unless the patches of both states have the same build: numbers, images and kinds.
void check_same_build(const PatchSet &now, const PatchSet &before);

}  // namespace riis
