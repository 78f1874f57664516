// SPDX-License-Identifier: Apache-2.0
// The edges of a mesh in blocks of 64 rows, each with the length of its longest edge and a box. A search for long edges near the
// surface passes over the other blocks as a whole.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/bounds.hpp"
#include "geometry/strided.hpp"
#include "marking/adjacency.hpp"

namespace riis {

struct EdgeBlocks {
  static constexpr std::int64_t rows_per_block = 64;

  struct Block {
    double longest = 0;  // length of the longest edge of its rows
    Bounds bounds;       // box of its edges
  };
  std::vector<Block> blocks;
  double longest = 0;  // length of the mesh's longest edge
};

// Fails with RIIS_INVALID_MESH if a coordinate is not usable.
EdgeBlocks edge_blocks(const StridedPoints &nodes, const Adjacency &adjacency, int n_threads);

}  // namespace riis
