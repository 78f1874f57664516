// SPDX-License-Identifier: Apache-2.0
// Patches to grids of quads (paper, 3.2 and 3.3).
// In: curves and patches of a valve, the error allowed. Out: a grid for each patch that leaves enough of that error for
// the quads' split into triangles.
#pragma once

#include <vector>

#include "geometry/coons.hpp"
#include "valve/patches.hpp"

namespace riis {

// One grid a patch, in their order, before any image of it is put in place. Curves are kept within their share of max_error, times
// tightness of each (1 for all, if there is none). Fails with RIIS_LIMIT_EXCEEDED where it would take more than
// max_triangles triangles.
std::vector<QuadGrid> make_grids(const PatchSet &set, double max_error, const std::vector<double> &tightness = {},
                                 int n_threads = 1);

// Fails with RIIS_LIMIT_EXCEEDED for more than max_triangles.
void check_count(double n_triangles, double max_error);

}  // namespace riis
