// SPDX-License-Identifier: Apache-2.0
// Open regions: the connected components of the nodes that are neither closed nor masked out.
// In: an adjacency, the closed nodes. Out: for each node, the lowest node of its region.
#pragma once

#include <cstdint>
#include <vector>

#include "common/array_view.hpp"
#include "mesh/adjacency.hpp"

namespace riis {

struct OpenNodes {
  const Adjacency &adjacency;
  const std::uint8_t *node_mask;               // or null
  const std::vector<std::int64_t> &closed_id;  // in any order
};

// Writes a label for each row of the adjacency, and returns the number of regions. The label is the lowest node of the region,
// or OpenSets::closed for a node in no region. An edge may be in the row of one node or of both.
std::int64_t label_open_regions(const OpenNodes &nodes, int n_threads, ArrayView<std::int64_t> label);

}  // namespace riis
