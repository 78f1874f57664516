// SPDX-License-Identifier: Apache-2.0
#include "pipeline/mark_nodes.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// Returns whether a search over clusters is faster. If most nodes are outside the limit, it is faster only from the mesh's second
// marking on.
bool do_clusters_pay_off(const SearchRequest &request, bool is_first) {
  if (request.surface.other_distance()) return false;
  if (request.mesh.nodes().grid) return true;
  return has_few_near(request) ? !is_first : are_enough_for_clusters(request.mesh.nodes().n, request.surface);
}

// Chooses the search. The limits of RIIS_SEARCH_AUTO are in search/cluster_search.cpp.
std::int32_t search_for(const SearchRequest &request, std::int32_t asked_for) {
  const PatchDistance *other = request.surface.other_distance();
  if (other && asked_for == RIIS_SEARCH_CLUSTERS)
    fail(RIIS_INVALID_ARGUMENT, "options.search is ", asked_for,
         ", clusters, which need distances to triangles, but the surface's distances are by ", other->name());
  const bool is_first = !request.mesh.record_marking();
  if (asked_for == RIIS_SEARCH_AUTO)
    asked_for = do_clusters_pay_off(request, is_first) ? RIIS_SEARCH_CLUSTERS : RIIS_SEARCH_EXHAUSTIVE;
  const bool walks = asked_for == RIIS_SEARCH_NEIGHBOR || asked_for == RIIS_SEARCH_PAPER;
  if (walks && request.mesh.nodes().grid)
    fail(RIIS_INVALID_ARGUMENT, "options.search is ",
         asked_for == RIIS_SEARCH_NEIGHBOR ? "RIIS_SEARCH_NEIGHBOR" : "RIIS_SEARCH_PAPER",
         ", which needs memory for each node, but the mesh is a grid: use RIIS_SEARCH_AUTO");
  if (walks && !request.mesh.adjacency().has_value())
    fail(RIIS_INVALID_ARGUMENT, "options.search is ", asked_for,
         ", which walks along the mesh's adjacency, but the mesh has none: see riis_mesh_set_adjacency");
  return asked_for;
}

// The search that ran, and its report.
struct SearchRun {
  std::int32_t search;
  SearchReport report;
};

// Searches over clusters. If the mesh has too many nodes for clusters, or if single precision is too coarse, searches
// exhaustively instead.
SearchRun run_clusters(const SearchRequest &request, Marks &marks) {
  if (request.mesh.nodes().n <= max_clustered_nodes) {
    const Clusters &clusters = request.mesh.clusters(request.n_threads);
    if (separates_in_single_precision(request, clusters.frame))
      return {RIIS_SEARCH_CLUSTERS,
              search_clusters(request, clusters, kernels(request.instructions), marks.cluster_scratch, marks.found)};
  }
  return {RIIS_SEARCH_EXHAUSTIVE, search_exhaustively(request, marks.found)};
}

// Returns the nodes of a grid that may be within the limit. The box is enlarged by several times the rounding error.
GridBox box_near(const SearchRequest &request, const Grid &grid) {
  const TriangleScene &scene = request.surface.scene();
  Bounds bounds = scene.bounds();
  const double reach = request.distance_limit + request.surface.triangle_error() + 8 * scene.rounding();
  const double margin = reach + 1e-12 * (reach + bounds.largest_coordinate());
  bounds.lower = bounds.lower - Vec3{margin, margin, margin};
  bounds.upper = bounds.upper + Vec3{margin, margin, margin};
  return grid.within(bounds);
}

SearchRun run_on_grid(const SearchRequest &request, const Grid &grid, std::int32_t search, Marks &marks) {
  constexpr std::int64_t most_by_other_distances = 100000000;
  const PatchDistance *const other = request.surface.other_distance();
  if (other && grid.all().n_nodes() > most_by_other_distances)
    fail(RIIS_LIMIT_EXCEEDED, "the surface's distances are by ", other->name(), ", for which a grid has at most ",
         most_by_other_distances, " nodes; this grid has ", grid.all().n_nodes());
  const GridBox box = box_near(request, grid);
  if (box.is_empty()) {
    marks.found.prepare(1);
    return {search, {0, 1, true, 0}};
  }
  marks.found.numbers = {grid.number(box.begin), grid.number({box.end[0] - 1, box.end[1] - 1, box.end[2] - 1}) + 1};
  if (search == RIIS_SEARCH_CLUSTERS) {
    marks.grid_clusters.make(grid, box);
    if (separates_in_single_precision(request, marks.grid_clusters.frame()))
      return {search, search_clusters(request, marks.grid_clusters, kernels(request.instructions),
                                      marks.cluster_scratch, marks.found)};
  }
  return {RIIS_SEARCH_EXHAUSTIVE, search_exhaustively(request, grid, box, marks.found)};
}

SearchRun run(const SearchRequest &request, std::int32_t search, Marks &marks) {
  static const std::vector<std::int64_t> nowhere;
  marks.found.numbers = {0, request.mesh.nodes().n};
  if (const Grid *const grid = request.mesh.nodes().grid) return run_on_grid(request, *grid, search, marks);
  if (request.mesh.nodes().n == 0) {
    // A process of a parallel solver may have no nodes. There every search finds nothing, and its result is complete.
    marks.found.prepare(1);
    return {search, {0, 1, true, 0}};
  }
  switch (search) {
    case RIIS_SEARCH_NEIGHBOR: {
      // A moving valve is near its last position, so the walk starts at the nodes that were found last. If they belong to another
      // mesh with the same number of nodes, this wrong start does no harm.
      const bool fits = marks.stats.n_nodes == request.mesh.nodes().n;
      return {search, search_neighbors(request, fits ? marks.within.nodes.node_id : nowhere, marks.neighbor_scratch,
                                       marks.found)};
    }
    case RIIS_SEARCH_PAPER:
      return {search, search_as_the_paper(request, marks.neighbor_scratch, marks.found)};
    case RIIS_SEARCH_CLUSTERS:
      return run_clusters(request, marks);
    default:
      return {search, search_exhaustively(request, marks.found)};
  }
}

// Returns the data that the caller requested, and the fields that are needed to compute K and K u_surface.
WantedData wanted_data(const SearchRequest &request, const MarkingRequest &asked) {
  WantedData data;
  data.fields = data.given_fields = asked.fields;
  data.k = asked.resistance != nullptr;
  if (request.surface.band().steps_aside()) data.fields |= field_height;
  if (asked.fields & RIIS_FIELD_GRADIENT) data.n_directions = request.surface.n_directions();
  if (!data.k) return data;
  if (asked.resistance->cuts_rim) data.fields |= RIIS_FIELD_RIM;
  data.k_u_surface = !request.surface.other_distance() && !request.surface.triangles().velocity.empty();
  if (data.k_u_surface) data.fields |= RIIS_FIELD_VELOCITY;
  return data;
}

// Copies those nodes of a list that are in the band, and their fields. The list must have heights. Both arguments may be the same
// list.
void take_marked(const Band &band, const FieldSet &fields, const ListedNodes &from, ListedNodes &to) {
  const std::int64_t n_from = from.nodes.size();
  const auto is_marked = [&](std::int64_t i) {
    return band.holds(view(from.nodes.distance)[i], view(from.fields.height)[i]);
  };
  to.fields.resize(fields, n_from);
  std::int64_t n = 0;
  // Copies each run of successive marked nodes at once.
  for (std::int64_t begin = 0, end = 0; begin < n_from; begin = end + 1) {
    for (end = begin; end < n_from && is_marked(end);) ++end;
    copy_nodes(from.nodes, {begin, end}, to.nodes, n);
    copy_fields(fields, from.fields, {begin, end}, to.fields, n);
    n += end - begin;
  }
  to.nodes.resize(n);
  to.fields.resize(fields, n);
}

// Gives both lists room for their new entries. If one of them lacks room, both are replaced by new lists. This happens only after
// all memory for the new lists has been reserved.
void make_room(const WantedData &data, const OrderScratch::Counts &n, Marks &marks) {
  if (!marks.within.has_room(data, n.n_within) || !marks.marked.has_room(data, n.n_marked)) {
    ListedNodes within, marked;
    within.reserve(data, n.n_within);
    marked.reserve(data, n.n_marked);
    marks.within = std::move(within);
    marks.marked = std::move(marked);
  }
  marks.within.nodes.resize(n.n_within);
  marks.marked.nodes.resize(n.n_marked);
}

}  // namespace

bool ListedNodes::has_room(const WantedData &data, std::int64_t n) const {
  return nodes.has_room(n) && fields.has_room(data.field_set(), n) && (!data.k || riis::has_room(k, n)) &&
         (!data.k_u_surface || riis::has_room(k_u_surface, 3 * n)) &&
         riis::has_room(k_gradient, data.n_k_gradients() * n);
}

void ListedNodes::reserve(const WantedData &data, std::int64_t n) {
  nodes.reserve(n);
  fields.reserve(data.field_set(), n);
  if (data.k) reserve_amply(k, n);
  if (data.k_u_surface) reserve_amply(k_u_surface, 3 * n);
  if (data.n_k_gradients() > 0) reserve_amply(k_gradient, data.n_k_gradients() * n);
}

void mark_nodes(const SearchRequest &asked, const MarkingRequest &marking, Marks &marks) {
  const auto start = std::chrono::steady_clock::now();
  check_fields(asked.surface, marking.fields);
  SearchRequest request = asked;
  const WantedData data = wanted_data(request, marking);
  request.ties = ties_for(request.surface, data.fields);
  request.listed = marking.listed;
  const auto [search, report] = run(request, search_for(request, marking.search), marks);
  const Band &band = request.surface.band();
  const bool limit_is_wider =
      band.steps_aside() ? !marking.listed : request.distance_limit > request.surface.half_thickness();
  // With an offset, it is known only from the fields which nodes are marked.
  const bool sorts_marked = limit_is_wider && !band.steps_aside();
  // All steps that may fail come first, so that a failure leaves the old lists unchanged.
  marks.field_scratch.prepare(request, data.fields, marks.found);
  if (need_normals(request.surface, data.fields, marks.found.size())) request.surface.pseudonormals();
  marks.leaflet_ids.reserve(request.surface.leaflet_ids().size());
  OrderScratch::Counts n =
      prepare_order(request.surface, marks.found, sorts_marked, request.n_threads, marks.order_scratch);
  if (limit_is_wider && !sorts_marked) n.n_marked = n.n_within;
  make_room(data, n, marks);
  put_in_order(request.surface, sorts_marked, marks.found.numbers, request.n_threads, marks.order_scratch,
               marks.within.nodes, marks.marked.nodes);
  make_fields(request, data.fields, marks.within.nodes, marks.field_scratch, marks.within.fields);
  if (marking.listed) take_marked(*marking.listed, data.field_set(), marks.within, marks.within);
  if (limit_is_wider && !sorts_marked) take_marked(band, data.field_set(), marks.within, marks.marked);
  if (sorts_marked)
    select_fields(data.field_set(), marks.within.nodes, marks.within.fields, marks.marked.nodes, marks.marked.fields);
  for (ListedNodes *list : {&marks.within, &marks.marked})
    list_resistance(marking.resistance, data, request.n_threads, *list);
  marks.leaflet_ids = request.surface.leaflet_ids();
  marks.data = data;
  marks.was_marked = true;
  marks.limit_is_wider = limit_is_wider;
  marks.distance_limit = request.distance_limit;
  marks.band = band;
  marks.n_threads = request.n_threads;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  marks.stats = {request.mesh.nodes().n,
                 marks.marked_nodes().size(),
                 marks.within.nodes.size(),
                 report.n_queries,
                 elapsed.count(),
                 search,
                 report.n_threads,
                 report.complete ? 1 : 0,
                 RIIS_INSTRUCTIONS_BASELINE +
                     (request.surface.other_distance() ? 0 : static_cast<std::int32_t>(request.instructions)),
                 report.n_unreached};
}

void write_dense(const Marks &marks, const riis_dense_arrays &to) {
  constexpr std::int64_t nodes_per_block = 65536, few = 8 * nodes_per_block;
  const std::int64_t n_nodes = marks.stats.n_nodes;
  parallel_for_ranges(n_nodes, nodes_per_block, marks.n_threads.for_part(n_nodes, few), [&](const Range &range, int) {
    const auto [begin, end] = range;
    if (to.mark) std::fill(to.mark + begin, to.mark + end, std::uint8_t{0});
    if (to.distance) std::fill(to.distance + begin, to.distance + end, to.far_distance);
    if (to.triangle_id) std::fill(to.triangle_id + begin, to.triangle_id + end, std::int64_t{-1});
    if (to.leaflet_id) std::fill(to.leaflet_id + begin, to.leaflet_id + end, -1);
  });
  if (to.mark)
    for (const std::int64_t node : marks.marked_nodes().node_id) to.mark[node] = 1;
  const NodeList &within = marks.within.nodes;
  for (std::int64_t i = 0; i < within.size(); ++i) {
    const std::int64_t node = view(within.node_id)[i];
    if (to.distance) to.distance[node] = view(within.distance)[i];
    if (to.triangle_id) to.triangle_id[node] = view(within.triangle_id)[i];
    if (to.leaflet_id) to.leaflet_id[node] = view(within.leaflet_id)[i];
  }
}

}  // namespace riis
