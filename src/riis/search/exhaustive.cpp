// SPDX-License-Identifier: Apache-2.0
#include "common/array_view.hpp"
#include "search/search.hpp"

#include <atomic>

#include "base/errors.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// Blocks are small enough for two threads to get equal shares of a coarse mesh's band, and large enough to be handed out
// cheaply.
constexpr std::int64_t nodes_per_block = 2048;

template <class Distances>
SearchReport query_every_node(const SearchRequest &request, const Distances &distances, FoundNodes &found) {
  const StridedPoints &nodes = request.mesh.nodes();
  const double limit = request.distance_limit;

  found.prepare(request.n_threads, request.ties);
  std::atomic<std::int64_t> n_queries{0};

  const int n_ran = openmp_for_ranges(nodes.n, nodes_per_block, request.n_threads, [&](const Range &range, int thread) {
    Ties *const ties = found.ties_of(thread);
    std::int64_t n_queries_here = 0;
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      if (request.is_masked_out(i)) continue;
      const Vec3 p = checked_point(nodes, i, "node", RIIS_INVALID_MESH);
      if (!distances.may_be_within(p, limit)) continue;
      ++n_queries_here;
      const ClosestTriangle closest = distances.closest(p, limit, ties);
      if (closest.triangle >= 0) found.add(thread, i, closest);
    }
    n_queries.fetch_add(n_queries_here, std::memory_order_relaxed);
  });
  return {n_queries, n_ran, true, 0};
}

}  // namespace

SearchReport search_exhaustively(const SearchRequest &request, FoundNodes &found) {
  return with_distances(request.surface, request.instructions,
                        [&](const auto &distances) { return query_every_node(request, distances, found); });
}

}  // namespace riis
