// SPDX-License-Identifier: Apache-2.0
// What every search is asked, and what it says.
// In: surface, nodes, limit. Out: nodes within the limit, ascending, with distance and triangle.
#pragma once

#include "distance/surface.hpp"
#include "marking/mark_result.hpp"
#include "marking/mesh.hpp"

namespace riis {

struct SearchRequest {
  const Surface &surface;
  const Mesh &mesh;
  double distance_limit;
  const std::uint8_t *node_mask;  // or null
  int n_threads;
  InstructionSet instructions;

  bool is_masked_out(std::int64_t node) const { return node_mask && !node_mask[node]; }
};

struct SearchReport {
  std::int64_t n_queries;
  int n_threads;
  bool complete;
  std::int64_t n_unreached;  // found by the neighbour search's proof
};

// All fill collection, and fail with RIIS_INVALID_MESH if a coordinate is not finite.

// Every node is asked (paper, 4.2.1 "Exhaustive node iteration").
SearchReport search_exhaustively(const SearchRequest &request, Collection &collection);

// Clusters of nodes that the surface may be near to, filtered in single precision, sixteen at a time (docs/theory.md, section 8).
SearchReport search_clusters(const SearchRequest &request, Collection &collection);

// False where single precision does not separate what is near from what is far, since the mesh is a million times as large as the
// surface, far from it, or smaller than it, or the limit is that large; and for more nodes than fit (max_clustered_nodes).
bool can_search_clusters(const SearchRequest &request);

// From neighbour to neighbour, and what is not reached is proven far (paper, 4.2.2 "Recursive neighbor search";
// docs/theory.md, section 7). `last` are nodes to begin with, such as those of the last marking. The mesh has an adjacency.
SearchReport search_neighbors(const SearchRequest &request, const std::vector<std::int64_t> &last,
                              Collection &collection);

// The paper's algorithm to the letter.
SearchReport search_as_the_paper(const SearchRequest &request, Collection &collection);

}  // namespace riis
