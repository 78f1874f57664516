// SPDX-License-Identifier: Apache-2.0
// Bounds the difference between the velocities of a surface's triangles and those of the smooth valve (docs/theory/velocity.md).
// In: the patches of two states, the time between them, the grids of the triangles. Out: a bound at equal (patch, u, v).
#pragma once

#include "base/recycled.hpp"
#include "geometry/placement.hpp"
#include "geometry/quads.hpp"
#include "valve/patches.hpp"

namespace riis {

// The two states that the velocities were computed from.
struct TwoStates {
  PatchSet now, before;
  Placement placement, placement_before;
  double seconds;
};

// `grids` are the grids of `now`, made with their lines kept.
double velocity_error_bound(const TwoStates &states, const Vector<LevelledGrid> &grids);

}  // namespace riis
