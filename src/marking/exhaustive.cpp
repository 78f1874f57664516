// SPDX-License-Identifier: Apache-2.0
#include "marking/search.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "api/errors.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// Small enough that two threads share a band of a coarse mesh evenly, large enough that handing out costs nothing.
constexpr std::int64_t nodes_per_block = 2048;

}  // namespace

SearchReport search_exhaustively(const SearchRequest &request, Collection &collection) {
  const StridedPoints &nodes = request.mesh.nodes();
  const TriangleScene &scene = request.surface.scene();
  const double limit = request.distance_limit;
  const std::int64_t n_blocks = (nodes.n + nodes_per_block - 1) / nodes_per_block;

  collection.blocks.resize(static_cast<std::size_t>(n_blocks));
  collection.prepare(request.n_threads);
  std::atomic<std::int64_t> n_queries{0};

  const int n_ran = parallel_for(n_blocks, request.n_threads, [&](std::int64_t block, int thread) {
    auto &found = collection.by_thread[static_cast<std::size_t>(thread)];
    const std::size_t first = found.size();
    const std::int64_t begin = block * nodes_per_block, end = std::min(begin + nodes_per_block, nodes.n);
    std::int64_t n_queries_here = 0;
    for (std::int64_t i = begin; i < end; ++i) {
      if (request.is_masked_out(i)) continue;
      const Vec3 p = nodes[i];
      if (!is_usable(p)) check_points(nodes, "node", RIIS_INVALID_MESH);
      if (!scene.may_be_within(p, limit)) continue;
      ++n_queries_here;
      const ClosestTriangle closest = scene.closest(p, limit);
      if (closest.triangle >= 0) found.push_back({i, std::sqrt(closest.distance_sq), closest.triangle});
    }
    collection.blocks[static_cast<std::size_t>(block)] = {thread, first, found.size()};
    n_queries.fetch_add(n_queries_here, std::memory_order_relaxed);
  });
  return {n_queries, n_ran, true, 0};
}

}  // namespace riis
