// SPDX-License-Identifier: Apache-2.0
#include "common/array_view.hpp"
#include "search/search.hpp"

#include <atomic>

#include "base/errors.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// Blocks are small enough to give two threads equal shares of the band, even in a coarse mesh. They are also large enough to be
// distributed in little time.
constexpr std::int64_t nodes_per_block = 2048;

struct EveryPoint {
  const StridedPoints &points;
  std::int64_t n = points.n;

  std::int64_t number(std::int64_t i) const { return i; }
  Vec3 at(std::int64_t i) const { return checked_point(points, i, "node", RIIS_INVALID_MESH); }
};

struct NodesOfBox {
  const Grid &grid;
  GridBox box;
  std::int64_t n = box.n_nodes();

  std::int64_t number(std::int64_t i) const { return grid.number(box[i]); }
  Vec3 at(std::int64_t i) const { return grid.at(box[i]); }
};

template <class Nodes, class Distances>
SearchReport query_every_node(const NodeSearch &request, const Nodes &nodes, const Distances &distances,
                              FoundNodes &found) {
  const double limit = request.distance_limit;

  found.prepare(request.n_threads, request.ties);
  std::atomic<std::int64_t> n_queries{0};

  const int n_ran = openmp_for_ranges(nodes.n, nodes_per_block, request.n_threads, [&](const Range &range, int thread) {
    Ties *const ties = found.ties_of(thread);
    std::int64_t n_queries_here = 0;
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      const std::int64_t node = nodes.number(i);
      if (request.is_masked_out(node)) continue;
      const Vec3 p = nodes.at(i);
      if (!distances.may_be_within(p, limit)) continue;
      ++n_queries_here;
      const ClosestTriangle closest = distances.closest(p, limit, ties);
      if (closest.triangle >= 0) found.add(thread, node, closest);
    }
    n_queries.fetch_add(n_queries_here, std::memory_order_relaxed);
  });
  return {n_queries, n_ran, true, 0};
}

}  // namespace

SearchReport search_exhaustively(const SearchRequest &request, FoundNodes &found) {
  return with_distances(request.surface, request.instructions, [&](const auto &distances) {
    return query_every_node(request, EveryPoint{request.mesh.points()}, distances, found);
  });
}

SearchReport search_exhaustively(const NodeSearch &request, const Grid &grid, const GridBox &box, FoundNodes &found) {
  return with_distances(request.surface, request.instructions, [&](const auto &distances) {
    return query_every_node(request, NodesOfBox{grid, box}, distances, found);
  });
}

}  // namespace riis
