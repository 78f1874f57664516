// SPDX-License-Identifier: Apache-2.0
// riis_mesh_*, riis_adjacency_*, riis_mark_*: argument checks around marking.
#include <limits>

#include "api/handles.hpp"
#include "api/structs.hpp"
#include "base/array_view.hpp"
#include "base/errors.hpp"
#include "marking/leaks.hpp"
#include "marking/mark_nodes.hpp"
#include "marking/open_regions.hpp"
#include "marking/passage.hpp"
#include "marking/resistance.hpp"

using riis::guarded;
using riis::require;
using riis::require_handle;

namespace {

// The structs' sizes in the first release.
constexpr std::int64_t options_size = 32, stats_size = 56, csr_size = 56, cells_size = 56, faces_size = 64,
                       leaks_size = 72, passage_size = 56, fields_size = 72, resistance_size = 32, band_sums_size = 48;

const riis_mark_options default_options{
    sizeof(riis_mark_options), RIIS_AUTO, nullptr, RIIS_SEARCH_AUTO, 0, RIIS_INSTRUCTIONS_AUTO, 0, 0, 0};
const riis_resistance default_resistance{sizeof(riis_resistance), std::numeric_limits<double>::quiet_NaN(), RIIS_AUTO,
                                         RIIS_RIM_ROUND, 0};

const riis_csr default_csr{sizeof(riis_csr), 0, 0, nullptr, nullptr, 32, 32, 0, 0};
const riis_cells default_cells{sizeof(riis_cells), 0, 0, nullptr, nullptr, 4, 32, 0, 0};
const riis_faces default_faces{sizeof(riis_faces), 0, 0, nullptr, nullptr, 1, 32, 0, 0, 0};

double limit_of(const riis_mark_options &options, double half_thickness) {
  if (options.distance_limit == RIIS_AUTO) return half_thickness;
  if (!(options.distance_limit >= half_thickness && options.distance_limit <= 1e60))
    riis::fail(RIIS_INVALID_ARGUMENT, "options.distance_limit is ", options.distance_limit,
               "; it must be from the half thickness, ", half_thickness, ", to 1e+60");
  return options.distance_limit;
}

// Returns the nodes' box, which is empty if there are none.
riis::Bounds check_nodes(const riis::StridedPoints &nodes) {
  if (nodes.n < 0) riis::fail(RIIS_INVALID_MESH, "n_nodes is ", nodes.n, "; it must be at least 0");
  if (nodes.n > riis::max_nodes)
    riis::fail(RIIS_LIMIT_EXCEEDED, "n_nodes is ", nodes.n, "; it must be at most ", riis::max_nodes);
  if (nodes.n == 0) return {};
  return riis::check_points(nodes, "node", RIIS_INVALID_MESH);
}

void check_search(std::int32_t search) {
  if (search < RIIS_SEARCH_AUTO || search > RIIS_SEARCH_CLUSTERS)
    riis::fail(RIIS_INVALID_ARGUMENT, "options.search is ", search, "; it must be one of RIIS_SEARCH_*");
}

riis::InstructionSet instructions_asked_for(std::int32_t instructions) {
  if (instructions < RIIS_INSTRUCTIONS_AUTO || instructions > RIIS_INSTRUCTIONS_AVX512)
    riis::fail(RIIS_INVALID_ARGUMENT, "options.instructions is ", instructions,
               "; it must be one of RIIS_INSTRUCTIONS_*");
  if (instructions == RIIS_INSTRUCTIONS_AUTO) return riis::best_instruction_set();
  const auto set = static_cast<riis::InstructionSet>(instructions - RIIS_INSTRUCTIONS_BASELINE);
  if (!riis::has(set))
    riis::fail(RIIS_UNAVAILABLE, "options.instructions is ", instructions, ", which this processor lacks");
  return set;
}

void get_list(const riis::NodeList &list, std::int64_t *n, const std::int64_t **node_id, const double **distance,
              const std::int64_t **triangle_id, const std::int32_t **leaflet_id) {
  riis::put(n, list.size());
  const bool empty = list.size() == 0;
  riis::put(node_id, empty ? nullptr : list.node_id.data());
  riis::put(distance, empty ? nullptr : list.distance.data());
  riis::put(triangle_id, empty ? nullptr : list.triangle_id.data());
  riis::put(leaflet_id, empty ? nullptr : list.leaflet_id.data());
}

void get_fields(const riis::NodeFields &made, std::int64_t n, riis_mark_fields *fields, int64_t struct_size) {
  const auto array = [](const auto &values) { return values.empty() ? nullptr : values.data(); };
  riis::write_struct<fields_size>(
      fields, struct_size, "fields",
      riis_mark_fields{n, array(made.point), array(made.normal), array(made.barycentric), array(made.uv),
                       array(made.velocity), array(made.side), array(made.rim), array(made.patch_id)});
}

void check_n_nodes(std::int64_t n_nodes, const riis::MarkResult &result) {
  if (n_nodes != result.stats.n_nodes)
    riis::fail(RIIS_INVALID_ARGUMENT, "n_nodes is ", n_nodes, "; the result is of a mesh with ", result.stats.n_nodes,
               " nodes");
}

riis::Resistance resistance_of(const riis_resistance *resistance, const riis::MarkResult &result) {
  return riis::checked_resistance(
      riis::completed<resistance_size>(require(resistance, "resistance"), "resistance", default_resistance), result);
}

// Checks an array of the caller's with an entry for each node. A process without nodes may have none.
const double *require_of_nodes(const double *array, const char *name, std::int64_t n_nodes) {
  return n_nodes == 0 ? array : require(array, name);
}

riis_mark_options whole_of(const riis_mark_options *options) {
  const riis_mark_options whole = riis::completed<options_size>(options, "options", default_options);
  riis::check_reserved("options.reserved", whole.reserved);
  riis::check_reserved("options.reserved2", whole.reserved2);
  return whole;
}

riis::Threads threads_of(const riis_mark_options &options, const riis::Mesh &mesh) {
  return riis::threads_for(options.n_threads, "options.n_threads", mesh.nodes().n, riis::nodes_per_thread);
}

riis::SearchRequest request_of(const riis::Surface &surface, const riis_mesh *mesh, const riis_mark_options &options) {
  check_search(options.search);
  return {surface,           mesh->mesh,                      limit_of(options, surface.half_thickness()),
          options.node_mask, threads_of(options, mesh->mesh), instructions_asked_for(options.instructions)};
}

// Checks the surface first, then the mesh, the result and the options.
riis::SearchRequest checked_request(const riis_surface *surface, const riis_mesh *mesh, const riis_mark_result *result,
                                    const riis_mark_options *options, std::int32_t &search,
                                    std::int32_t *fields = nullptr) {
  const riis::Surface &content = riis::content_of(surface);
  require_handle(mesh, "mesh");
  require_handle(result, "result");
  const riis_mark_options whole = whole_of(options);
  const riis::SearchRequest request = request_of(content, mesh, whole);
  search = whole.search;
  riis::put(fields, whole.fields);
  return request;
}

const riis::Adjacency &require_adjacency(const riis::Mesh &mesh, const char *purpose) {
  if (!mesh.adjacency().has_value())
    riis::fail(RIIS_INVALID_ARGUMENT, "mesh has no adjacency, ", purpose, ": see riis_mesh_set_adjacency");
  return *mesh.adjacency();
}

// Refuses a result that was not marked with this mesh, as far as its size shows it.
void check_is_of_mesh(const riis::Mesh &mesh, const riis::MarkResult &result) {
  if (!result.was_marked) riis::fail(RIIS_INVALID_ARGUMENT, "result was never marked with: call riis_mark_nodes first");
  if (result.stats.n_nodes != mesh.nodes().n)
    riis::fail(RIIS_INVALID_ARGUMENT, "result is of a mesh with ", result.stats.n_nodes, " nodes, mesh has ",
               mesh.nodes().n);
}

// Refuses a result that was not marked with this surface and mesh, as far as its sizes show it.
void check_is_of_marking(const riis::SearchRequest &request, const riis::MarkResult &result) {
  require_adjacency(request.mesh, "whose edges may leak");
  check_is_of_mesh(request.mesh, result);
  if (result.half_thickness != request.surface.half_thickness())
    riis::fail(RIIS_INVALID_ARGUMENT, "result is of a surface with the half thickness ", result.half_thickness,
               ", surface has ", request.surface.half_thickness(), ": mark the nodes again");
}

// Checks an end of a passage, `name`.
riis::ArrayView<const std::int64_t> checked_end(const riis::SearchRequest &request, const char *name, std::int64_t n,
                                                const std::int64_t *ids) {
  const std::int64_t n_nodes = request.mesh.nodes().n;
  if (n < 1) riis::fail(RIIS_INVALID_ARGUMENT, "n_", name, " is ", n, "; it must be at least 1");
  require(ids, name);
  for (std::int64_t i = 0; i < n; ++i) {
    if (ids[i] < 0 || ids[i] >= n_nodes)
      riis::fail(RIIS_INVALID_ARGUMENT, name, "[", i, "] is ", ids[i], "; the mesh has ", n_nodes, " nodes, from 0");
    if (request.is_masked_out(ids[i]))
      riis::fail(RIIS_INVALID_ARGUMENT, name, "[", i, "] is node ", ids[i], ", which options.node_mask leaves out");
  }
  return {ids, n};
}

}  // namespace

extern "C" {

riis_status riis_mesh_create(int64_t n_nodes, const double *x, const double *y, const double *z, int64_t stride,
                             riis_mesh **mesh) {
  return guarded([&] {
    require(mesh, "mesh");
    const riis::StridedPoints nodes{n_nodes, x, y, z, stride};
    *mesh = new riis_mesh(nodes, check_nodes(nodes));
  });
}

riis_status riis_mesh_update(riis_mesh *mesh, int64_t n_nodes, const double *x, const double *y, const double *z,
                             int64_t stride) {
  return guarded([&] {
    riis::Mesh &content = require_handle(mesh, "mesh")->mesh;
    content.forget_places();  // the nodes moved, even if the new coordinates are refused
    const riis::StridedPoints nodes{n_nodes, x, y, z, stride};
    content.set_nodes(nodes, check_nodes(nodes));
  });
}

riis_status riis_mesh_prepare(riis_mesh *mesh, int32_t n_threads) {
  return guarded([&] {
    const riis::Mesh &content = require_handle(mesh, "mesh")->mesh;
    const int n = riis::threads_for(n_threads, "n_threads", content.nodes().n, riis::nodes_per_thread);
    if (content.nodes().n > riis::max_clustered_nodes)
      riis::fail(RIIS_LIMIT_EXCEEDED, "a mesh of ", content.nodes().n, " nodes is not made clusters of: at most ",
                 riis::max_clustered_nodes);
    if (content.nodes().n > 0) content.clusters(n);
  });
}

void riis_mesh_destroy(riis_mesh **mesh) { riis::destroy_handle(mesh, "mesh"); }

riis_status riis_csr_init(riis_csr *csr, int64_t struct_size) {
  return guarded([&] { riis::init_struct<csr_size>(csr, struct_size, "csr", default_csr); });
}

riis_status riis_mesh_set_adjacency(riis_mesh *mesh, const riis_csr *csr) {
  return guarded([&] {
    riis::Mesh &content = require_handle(mesh, "mesh")->mesh;
    if (csr)
      content.set_adjacency(
          riis::checked_adjacency(riis::completed<csr_size>(csr, "csr", default_csr), content.nodes().n));
    else
      content.set_adjacency(std::nullopt);
  });
}

riis_status riis_cells_init(riis_cells *cells, int64_t struct_size) {
  return guarded([&] { riis::init_struct<cells_size>(cells, struct_size, "cells", default_cells); });
}

riis_status riis_adjacency_create_from_cells(const riis_cells *cells, riis_adjacency **adjacency) {
  return guarded([&] {
    require(adjacency, "adjacency");
    const riis_cells whole = riis::completed<cells_size>(require(cells, "cells"), "cells", default_cells);
    const int n_threads = riis::threads_for(whole.n_threads, "cells.n_threads", whole.n_cells, riis::nodes_per_thread);
    *adjacency = new riis_adjacency{{}, riis::adjacency_from_cells(whole, n_threads)};
  });
}

riis_status riis_faces_init(riis_faces *faces, int64_t struct_size) {
  return guarded([&] { riis::init_struct<faces_size>(faces, struct_size, "faces", default_faces); });
}

riis_status riis_adjacency_create_from_faces(const riis_faces *faces, riis_adjacency **adjacency) {
  return guarded([&] {
    require(adjacency, "adjacency");
    const riis_faces whole = riis::completed<faces_size>(require(faces, "faces"), "faces", default_faces);
    const int n_threads = riis::threads_for(whole.n_threads, "faces.n_threads", whole.n_faces, riis::nodes_per_thread);
    *adjacency = new riis_adjacency{{}, riis::adjacency_from_faces(whole, n_threads)};
  });
}

riis_status riis_adjacency_create_from_grid(int64_t ni, int64_t nj, int64_t nk, int32_t n_threads,
                                            riis_adjacency **adjacency) {
  return guarded([&] {
    require(adjacency, "adjacency");
    const int n = riis::threads_for(n_threads, "n_threads", riis::nodes_of_grid(ni, nj, nk), riis::nodes_per_thread);
    *adjacency = new riis_adjacency{{}, riis::adjacency_from_grid(ni, nj, nk, n)};
  });
}

riis_status riis_adjacency_csr(const riis_adjacency *adjacency, riis_csr *csr, int64_t struct_size) {
  return guarded([&] {
    riis_csr value = require_handle(adjacency, "adjacency")->adjacency.csr();
    value.struct_size = struct_size;
    riis::write_struct<csr_size>(csr, struct_size, "csr", value);
  });
}

void riis_adjacency_destroy(riis_adjacency **adjacency) { riis::destroy_handle(adjacency, "adjacency"); }

riis_status riis_mark_result_create(riis_mark_result **result) {
  return guarded([&] {
    require(result, "result");
    *result = new riis_mark_result{};
  });
}

void riis_mark_result_destroy(riis_mark_result **result) { riis::destroy_handle(result, "result"); }

riis_status riis_mark_options_init(riis_mark_options *options, int64_t struct_size) {
  return guarded([&] { riis::init_struct<options_size>(options, struct_size, "options", default_options); });
}

riis_status riis_mark_nodes(const riis_surface *surface, const riis_mesh *mesh, const riis_mark_options *options,
                            riis_mark_result *result) {
  return guarded([&] {
    std::int32_t search = RIIS_SEARCH_AUTO, fields = 0;
    const riis::SearchRequest request = checked_request(surface, mesh, result, options, search, &fields);
    riis::mark_nodes(request, search, fields, result->result);
    riis::check_proportions(
        {mesh->mesh.nodes().n, mesh->mesh.bounds(), request.surface.scene().bounds(), request.surface.half_thickness()},
        surface->number, mesh->mesh.warned());
  });
}

riis_status riis_mark_result_marked(const riis_mark_result *result, int64_t *n_marked, const int64_t **node_id,
                                    const double **distance, const int64_t **triangle_id, const int32_t **leaflet_id) {
  return guarded([&] {
    get_list(require_handle(result, "result")->result.marked_nodes(), n_marked, node_id, distance, triangle_id,
             leaflet_id);
  });
}

riis_status riis_mark_result_within_limit(const riis_mark_result *result, int64_t *n_within, const int64_t **node_id,
                                          const double **distance, const int64_t **triangle_id,
                                          const int32_t **leaflet_id) {
  return guarded([&] {
    get_list(require_handle(result, "result")->result.within, n_within, node_id, distance, triangle_id, leaflet_id);
  });
}

riis_status riis_mark_result_marked_fields(const riis_mark_result *result, riis_mark_fields *fields,
                                           int64_t struct_size) {
  return guarded([&] {
    const riis::MarkResult &content = require_handle(result, "result")->result;
    get_fields(content.marked_fields(), content.marked_nodes().size(), fields, struct_size);
  });
}

riis_status riis_mark_result_within_limit_fields(const riis_mark_result *result, riis_mark_fields *fields,
                                                 int64_t struct_size) {
  return guarded([&] {
    const riis::MarkResult &content = require_handle(result, "result")->result;
    get_fields(content.fields_within, content.within.size(), fields, struct_size);
  });
}

riis_status riis_resistance_init(riis_resistance *resistance, int64_t struct_size) {
  return guarded(
      [&] { riis::init_struct<resistance_size>(resistance, struct_size, "resistance", default_resistance); });
}

riis_status riis_mark_result_add_resistance(const riis_mark_result *result, const riis_resistance *resistance,
                                            int64_t n_nodes, double *coefficient, double *momentum) {
  return guarded([&] {
    const riis::MarkResult &content = require_handle(result, "result")->result;
    const riis::Resistance checked = resistance_of(resistance, content);
    check_n_nodes(n_nodes, content);
    riis::add_resistance(content, checked, coefficient, momentum);
  });
}

riis_status riis_mark_result_add_reaction(const riis_mark_result *result, const riis_resistance *resistance,
                                          int64_t n_nodes, const double *velocity, const double *weight,
                                          double *force) {
  return guarded([&] {
    const riis::MarkResult &content = require_handle(result, "result")->result;
    const riis::Resistance checked = resistance_of(resistance, content);
    check_n_nodes(n_nodes, content);
    riis::add_reaction(content, checked, require_of_nodes(velocity, "velocity", n_nodes),
                       require_of_nodes(weight, "weight", n_nodes), require(force, "force"));
  });
}

riis_status riis_mark_result_band_sums(const riis_mark_result *result, double inner, double outer, int64_t n_nodes,
                                       const double *value, const double *weight, riis_band_sums *sums,
                                       int64_t struct_size) {
  return guarded([&] {
    const riis::MarkResult &content = require_handle(result, "result")->result;
    check_n_nodes(n_nodes, content);
    if (!(inner >= 0 && inner <= outer))
      riis::fail(RIIS_INVALID_ARGUMENT, "inner is ", inner, "; it must be from 0 to outer, which is ", outer);
    if (!(outer <= content.distance_limit))
      riis::fail(RIIS_INVALID_ARGUMENT, "outer is ", outer, "; it must be at most the distance limit of the marking, ",
                 content.distance_limit);
    riis::write_struct<band_sums_size>(sums, struct_size, "sums",
                                       riis::band_sums(content, inner, outer, require_of_nodes(value, "value", n_nodes),
                                                       require_of_nodes(weight, "weight", n_nodes)));
  });
}

riis_status riis_mark_result_dense(const riis_mark_result *result, int64_t n_nodes, double far_distance, uint8_t *mark,
                                   double *distance, int64_t *triangle_id, int32_t *leaflet_id) {
  return guarded([&] {
    const riis::MarkResult &content = require_handle(result, "result")->result;
    check_n_nodes(n_nodes, content);
    riis::check_far_distance("far_distance", far_distance, content.distance_limit);
    riis::write_dense(content, far_distance, mark, distance, triangle_id, leaflet_id);
  });
}

riis_status riis_mark_result_stats(const riis_mark_result *result, riis_mark_stats *stats, int64_t struct_size) {
  return guarded([&] {
    const riis_mark_stats &of_last_marking = require_handle(result, "result")->result.stats;
    riis::write_struct<stats_size>(stats, struct_size, "stats", of_last_marking);
  });
}

riis_status riis_find_leaks(const riis_surface *surface, const riis_mesh *mesh, const riis_mark_options *options,
                            riis_mark_result *result, riis_leaks *leaks, int64_t struct_size) {
  return guarded([&] {
    std::int32_t search = RIIS_SEARCH_AUTO;
    const riis::SearchRequest request = checked_request(surface, mesh, result, options, search);
    riis::check_struct_size<leaks_size, riis_leaks>(struct_size, "leaks");
    require(leaks, "leaks");
    check_is_of_marking(request, result->result);
    riis::write_struct<leaks_size>(leaks, struct_size, "leaks", riis::find_leaks(request, result->result));
  });
}

riis_status riis_mark_result_leaking_edges(const riis_mark_result *result, int64_t *n_edges, const int64_t **node_id,
                                           const double **length, const double **distance) {
  return guarded([&] {
    const riis::LeakingEdges &edges = require_handle(result, "result")->result.leaking;
    const bool empty = edges.length.empty();
    riis::put(n_edges, riis::view(edges.length).size());
    riis::put(node_id, empty ? nullptr : edges.node_id.data());
    riis::put(length, empty ? nullptr : edges.length.data());
    riis::put(distance, empty ? nullptr : edges.distance.data());
  });
}

riis_status riis_label_open_regions(const riis_mesh *mesh, const riis_mark_options *options,
                                    const riis_mark_result *result, int64_t n_nodes, int64_t *label,
                                    int64_t *n_regions) {
  return guarded([&] {
    const riis::Mesh &nodes = require_handle(mesh, "mesh")->mesh;
    const riis::MarkResult &content = require_handle(result, "result")->result;
    const riis_mark_options whole = whole_of(options);
    const int n_threads = threads_of(whole, nodes);
    const riis::Adjacency &adjacency = require_adjacency(nodes, "whose edges join nodes");
    check_is_of_mesh(nodes, content);
    check_search(whole.search);
    limit_of(whole, content.half_thickness);
    instructions_asked_for(whole.instructions);
    check_n_nodes(n_nodes, content);
    if (n_nodes > 0) require(label, "label");
    riis::put(n_regions, riis::label_open_regions({adjacency, whole.node_mask, content.marked_nodes().node_id},
                                                  n_threads, {label, n_nodes}));
  });
}

riis_status riis_find_passage(const riis_surface *surface, const riis_mesh *mesh, const riis_mark_options *options,
                              int64_t n_from, const int64_t *from, int64_t n_to, const int64_t *to,
                              riis_passage *passage, int64_t struct_size) {
  return guarded([&] {
    const riis::Surface &content = riis::content_of(surface);
    require_handle(mesh, "mesh");
    const riis::SearchRequest request = request_of(content, mesh, whole_of(options));
    riis::check_struct_size<passage_size, riis_passage>(struct_size, "passage");
    require(passage, "passage");
    require_adjacency(request.mesh, "whose edges join nodes");
    const riis::PassageEnds ends{checked_end(request, "from", n_from, from), checked_end(request, "to", n_to, to)};
    riis::write_struct<passage_size>(passage, struct_size, "passage", riis::find_passage(request, ends));
  });
}
}
