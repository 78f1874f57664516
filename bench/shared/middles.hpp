// SPDX-License-Identifier: Apache-2.0
// The rule by which svMultiPhysics marks: a node's distance is the distance to the nearest middle of a triangle.
#pragma once

#include <cstdint>
#include <vector>

#include "references.hpp"

namespace bench {

// Returns the middles of triangles, (3, n): the means of their corners.
std::vector<double> middles_of(const Triangles &triangles);

// For each node, measures the distances to all middles, as svMultiPhysics does. distance: (n_nodes); xyz: (3, n_nodes).
void distances_to_middles(const std::vector<double> &middles, std::int64_t n_nodes, const double *xyz,
                          double *distance);

}  // namespace bench
