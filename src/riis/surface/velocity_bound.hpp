// SPDX-License-Identifier: Apache-2.0
// Bounds how far the velocities of a surface's triangles are from those of the smooth valve (docs/theory.md, "Velocity").
// In: the patches of two states, the time between them, the grids of the triangles. Out: a bound at equal (patch, u, v).
#pragma once

#include "base/recycled.hpp"
#include "geometry/placement.hpp"
#include "surface/quads.hpp"
#include "valve/patches.hpp"

namespace riis {

// The two states that velocities come from.
struct TwoStates {
  PatchSet now, before;
  Placement placement, placement_before;
  double seconds;
};

// The grids are those of `now`, and must have kept their lines.
double velocity_error_bound(const TwoStates &states, const Vector<LevelledGrid> &grids);

}  // namespace riis
