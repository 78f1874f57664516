// SPDX-License-Identifier: Apache-2.0
// Derivatives of a surface's vertices with respect to a parameter (docs/theory/gradients.md).
// The rates are computed from the patches and the grids of the surface, and from the patches of two states near the surface's
// state.
#pragma once

#include <vector>

#include "base/recycled.hpp"
#include "geometry/placement.hpp"
#include "geometry/quads.hpp"
#include "valve/patches.hpp"

namespace riis {

// A direction in which a valve changes. It consists of two states near the surface's state, and of the difference of the
// parameter between these two states.
struct Direction {
  const PatchSet &after, &before;  // both states may be the same object
  Placement placement_after, placement_before;
  double step;  // not 0
};

// Computes (after - before) / step for every vertex, in the order of the vertices of a TriangleSet. `at` and `grids` belong to
// the surface. The direction's two states are evaluated on the same grids. A vertex on a curve stays at the same fraction of the
// curve's length. A vertex on a chord stays at the same fraction of the chord, and a vertex inside a patch keeps its u and v. The
// rates are therefore rates of the triangles' corners, not of the smooth valve. Inside a triangle the rate is exactly linear.
void make_vertex_rates(const PatchSet &at, const Vector<LevelledGrid> &grids, const Direction &direction, int n_threads,
                       std::vector<double> &rates);

}  // namespace riis
