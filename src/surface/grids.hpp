// SPDX-License-Identifier: Apache-2.0
// Turns patches into grids of quads (paper, 3.2 and 3.3).
// In: curves and patches of a valve, the allowed error. Out: a grid for each patch, which leaves enough of that error
// for the split of quads into triangles.
#pragma once

#include <vector>

#include "geometry/coons.hpp"
#include "valve/patches.hpp"

namespace riis {

// Makes one grid for each patch, in their order, before any image of the patch is placed. Keeps each curve within its
// share of max_error times its tightness; an empty `tightness` means 1 for all. Fails with RIIS_LIMIT_EXCEEDED if the
// surface would take more than max_triangles triangles.
// With an earlier state of the same build, the grids also have the displacements of their points since.
std::vector<QuadGrid> make_grids(const PatchSet &set, double max_error, const std::vector<double> &tightness = {},
                                 int n_threads = 1, const PatchSet *before = nullptr);

// Fails with RIIS_LIMIT_EXCEEDED for more than max_triangles.
void check_count(double n_triangles, double max_error);

}  // namespace riis
