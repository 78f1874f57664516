// SPDX-License-Identifier: Apache-2.0
// Estimates how many mesh edges fit across the band: the band's thickness divided by the shortest, the mean and the longest
// length of the mesh edges that have a marked node.
// In: a marking, the mesh with its adjacency. Out: counts and lengths.
#pragma once

#include <riis/riis.h>

#include "marks/marks.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/mesh.hpp"

namespace riis {

// Computes the number of mesh edges across the band. Fails with RIIS_INVALID_MESH if a coordinate is not finite or too large.
riis_cells_across cells_across(const Marks &marks, const Mesh &mesh, const Adjacency &adjacency, int n_threads);

}  // namespace riis
