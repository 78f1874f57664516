// SPDX-License-Identifier: Apache-2.0
#include "marking/mark_nodes.hpp"

#include <algorithm>
#include <chrono>

#include "base/array_view.hpp"
#include "base/errors.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// Returns false for a limit so wide that most triangles are near most nodes: there clusters do not help.
bool has_few_near(const SearchRequest &request) {
  const Bounds &bounds = request.surface.scene().bounds();
  const Vec3 extent = bounds.upper - bounds.lower;
  return request.distance_limit <= 0.5 * std::max({extent.x, extent.y, extent.z});
}

// RIIS_SEARCH_AUTO becomes clusters once these pay for themselves: a mesh's first marking queries the nodes one by one.
std::int32_t search_for(const SearchRequest &request, std::int32_t asked_for) {
  const PatchDistance *other = request.surface.other_distance();
  if (other && asked_for == RIIS_SEARCH_CLUSTERS)
    fail(RIIS_INVALID_ARGUMENT, "options.search is ", asked_for,
         ", clusters, which are decided on triangles, but the surface's distances are by ", other->name());
  const bool is_first = !request.mesh.record_marking();
  if (asked_for == RIIS_SEARCH_AUTO)
    asked_for = !other && !is_first && has_few_near(request) ? RIIS_SEARCH_CLUSTERS : RIIS_SEARCH_EXHAUSTIVE;
  const bool walks = asked_for == RIIS_SEARCH_NEIGHBOR || asked_for == RIIS_SEARCH_PAPER;
  if (walks && !request.mesh.adjacency().has_value())
    fail(RIIS_INVALID_ARGUMENT, "options.search is ", asked_for,
         ", which walks along the mesh's adjacency, but the mesh has none: see riis_mesh_set_adjacency");
  return asked_for;
}

struct Ran {
  std::int32_t search;
  SearchReport report;
};

// Searches clusters, or exhaustively where the mesh has too many nodes for clusters or single precision is too coarse.
Ran run_clusters(const SearchRequest &request, MarkResult &result) {
  if (request.mesh.nodes().n <= max_clustered_nodes) {
    const Clusters &clusters = request.mesh.clusters(request.n_threads);
    if (separates_in_single_precision(request, clusters))
      return {RIIS_SEARCH_CLUSTERS,
              search_clusters(request, clusters, kernels(request.instructions), result.cluster_scratch, result.found)};
  }
  return {RIIS_SEARCH_EXHAUSTIVE, search_exhaustively(request, result.found)};
}

Ran run(const SearchRequest &request, std::int32_t search, MarkResult &result) {
  static const std::vector<std::int64_t> nowhere;
  if (request.mesh.nodes().n == 0) {
    // A rank may have no nodes. Then every search is complete and finds nothing.
    result.found.prepare(1);
    return {search, {0, 1, true, 0}};
  }
  switch (search) {
    case RIIS_SEARCH_NEIGHBOR: {
      // A moving valve is near its last place, so the walk starts at the nodes found last. A list from another mesh with as many
      // nodes does no harm.
      const bool fits = result.stats.n_nodes == request.mesh.nodes().n;
      return {search,
              search_neighbors(request, fits ? result.within.node_id : nowhere, result.neighbor_scratch, result.found)};
    }
    case RIIS_SEARCH_PAPER:
      return {search, search_as_the_paper(request, result.neighbor_scratch, result.found)};
    case RIIS_SEARCH_CLUSTERS:
      return run_clusters(request, result);
    default:
      return {search, search_exhaustively(request, result.found)};
  }
}

}  // namespace

void mark_nodes(const SearchRequest &asked, std::int32_t asked_for, std::int32_t fields, MarkResult &result) {
  const auto start = std::chrono::steady_clock::now();
  check_fields(asked.surface, fields);
  SearchRequest request = asked;
  request.ties = ties_for(request.surface, fields);
  const auto [search, report] = run(request, search_for(request, asked_for), result);
  const bool limit_is_wider = request.distance_limit > request.surface.half_thickness();
  // Calls that may fail come before the first list is overwritten.
  result.fields_within.reserve(fields, result.found.size());
  if (limit_is_wider) result.fields_marked.reserve(fields, result.found.size());
  result.field_scratch.prepare(request, fields, result.found);
  if (need_normals(request.surface, fields, result.found.size()))
    request.surface.pseudonormals();
  put_in_order(request.surface, result.found, limit_is_wider, request.mesh.nodes().n, request.n_threads,
               result.order_scratch, result.within, result.marked);
  make_fields(request, fields, result.within, result.field_scratch, result.fields_within);
  if (limit_is_wider) select_fields(fields, result.within, result.fields_within, result.marked, result.fields_marked);
  result.fields = fields;
  result.was_marked = true;
  result.limit_is_wider = limit_is_wider;
  result.distance_limit = request.distance_limit;
  result.half_thickness = request.surface.half_thickness();
  result.leaking = {};
  result.n_threads = request.n_threads;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  result.stats = {request.mesh.nodes().n,
                  result.marked_nodes().size(),
                  result.within.size(),
                  report.n_queries,
                  elapsed.count(),
                  search,
                  report.n_threads,
                  report.complete ? 1 : 0,
                  RIIS_INSTRUCTIONS_BASELINE +
                      (request.surface.other_distance() ? 0 : static_cast<std::int32_t>(request.instructions)),
                  report.n_unreached};
}

void write_dense(const MarkResult &result, double far_distance, std::uint8_t *mark, double *distance,
                 std::int64_t *triangle_id, std::int32_t *leaflet_id) {
  constexpr std::int64_t nodes_per_block = 65536, few = 8 * nodes_per_block;
  const std::int64_t n_nodes = result.stats.n_nodes;
  parallel_for_ranges(n_nodes, nodes_per_block, result.n_threads.for_part(n_nodes, few), [&](const Range &range, int) {
    const auto [begin, end] = range;
    if (mark) std::fill(mark + begin, mark + end, std::uint8_t{0});
    if (distance) std::fill(distance + begin, distance + end, far_distance);
    if (triangle_id) std::fill(triangle_id + begin, triangle_id + end, std::int64_t{-1});
    if (leaflet_id) std::fill(leaflet_id + begin, leaflet_id + end, -1);
  });
  for (const std::int64_t node : result.marked_nodes().node_id)
    if (mark) mark[node] = 1;
  const NodeList &within = result.within;
  for (std::int64_t i = 0; i < within.size(); ++i) {
    const std::int64_t node = view(within.node_id)[i];
    if (distance) distance[node] = view(within.distance)[i];
    if (triangle_id) triangle_id[node] = view(within.triangle_id)[i];
    if (leaflet_id) leaflet_id[node] = view(within.leaflet_id)[i];
  }
}

}  // namespace riis
