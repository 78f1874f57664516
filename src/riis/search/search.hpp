// SPDX-License-Identifier: Apache-2.0
// The request and the report that all searches share.
// In: surface, mesh, limit. Out: the nodes within the limit in any order, with distance and triangle.
#pragma once

#include <cstdint>

#include "mesh/mesh.hpp"
#include "parallel/threads.hpp"
#include "scene/surface.hpp"
#include "search/found_nodes.hpp"

namespace riis {

// A search among nodes, wherever they are stored.
struct NodeSearch {
  const Surface &surface;
  double distance_limit;
  const std::uint8_t *node_mask;  // or null
  Threads n_threads;
  InstructionSet instructions;
  TieRule ties = {};

  bool is_masked_out(std::int64_t node) const { return node_mask && !node_mask[node]; }
};

struct SearchRequest : NodeSearch {
  const Mesh &mesh;
};

struct SearchReport {
  std::int64_t n_queries;
  int n_threads;
  bool complete;
  std::int64_t n_unreached;  // number of nodes that only the neighbour search's proof found
};

// Every search fills FoundNodes in any order. It fails with RIIS_INVALID_MESH if it reads an unusable coordinate.

// Queries every node (paper, 4.2.1 "Exhaustive node iteration").
SearchReport search_exhaustively(const SearchRequest &request, FoundNodes &found);

}  // namespace riis
