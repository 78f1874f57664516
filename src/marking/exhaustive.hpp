// SPDX-License-Identifier: Apache-2.0
// Exhaustive search: every node is asked (paper, 4.2.1 "Exhaustive node iteration").
// In: surface, nodes, limit. Out: all nodes within the limit, ascending, with distance and triangle.
#pragma once

#include "marking/mark_result.hpp"
#include "marking/mesh.hpp"
#include "surface/surface.hpp"

namespace riis {

struct SearchRequest {
  const Surface &surface;
  const Mesh &mesh;
  double distance_limit;
  const std::uint8_t *node_mask;  // or null
  int n_threads;
};

struct SearchReport {
  std::int64_t n_queries;
  int n_threads;
};

// Fills collection. Fails with RIIS_INVALID_MESH if a coordinate is not finite.
SearchReport search_exhaustively(const SearchRequest &request, Collection &collection);

}  // namespace riis
