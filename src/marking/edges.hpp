// SPDX-License-Identifier: Apache-2.0
// The edges of a mesh by blocks of rows: how long they are and where, so that whoever seeks long ones near the surface passes over
// the others, sixty-four rows at a time.
#pragma once

#include <vector>

#include "geometry/bounds.hpp"
#include "geometry/strided.hpp"
#include "marking/adjacency.hpp"

namespace riis {

struct EdgeBlocks {
  static constexpr std::int64_t rows_per_block = 64;

  struct Block {
    double longest = 0;  // edge of its rows
    Bounds bounds;       // of its edges
  };
  std::vector<Block> blocks;
  double longest = 0;  // edge of all
};

// Fails with RIIS_INVALID_MESH if a coordinate is not usable.
EdgeBlocks edge_blocks(const StridedPoints &nodes, const Adjacency &adjacency, int n_threads);

}  // namespace riis
