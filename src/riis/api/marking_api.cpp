// SPDX-License-Identifier: Apache-2.0
// Checks the arguments of riis_mark_*, riis_marks_*, riis_leaks_* and riis_find_*. The work is in pipeline/, marks/, obstacle/
// and seal/.
#include <cmath>
#include <limits>
#include <optional>

#include "api/handles.hpp"
#include "api/structs.hpp"
#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "geometry/strided.hpp"
#include "measures/measures.hpp"
#include "obstacle/resistance.hpp"
#include "pipeline/mark_nodes.hpp"
#include "seal/seal.hpp"

using riis::guarded_with_handles;
using riis::require;
using riis::require_handle;

namespace {

const riis_mark_options default_mark_options{
    sizeof(riis_mark_options), RIIS_AUTO, nullptr, nullptr, 0, RIIS_SEARCH_AUTO, 0, RIIS_INSTRUCTIONS_AUTO};
const riis_resistance default_resistance{sizeof(riis_resistance), std::numeric_limits<double>::quiet_NaN(), RIIS_AUTO,
                                         RIIS_RIM_ROUND, 0};
const riis_dense_arrays default_dense{
    sizeof(riis_dense_arrays), 0, RIIS_FAR_DISTANCE, nullptr, nullptr, nullptr, nullptr};
const riis_resistance_arrays default_resistance_arrays{sizeof(riis_resistance_arrays), 0, nullptr, 1,
                                                       {nullptr, nullptr, nullptr},    1};
const riis_flow_arrays default_flow{sizeof(riis_flow_arrays), 0, {nullptr, nullptr, nullptr}, 1, nullptr};
const riis_reaction default_reaction{
    sizeof(riis_reaction), {0, 0, 0}, nullptr, nullptr, 0, nullptr, nullptr, 0, nullptr, nullptr, nullptr, nullptr};
const riis_band default_band{sizeof(riis_band), 0, 0, 0, nullptr, nullptr};
const riis_passage_ends default_ends{sizeof(riis_passage_ends), 0, nullptr, 0, nullptr};

double limit_of(const riis_mark_options &options, const riis::Band &band) {
  if (options.distance_limit == RIIS_AUTO) return band.reach();
  if (!(options.distance_limit >= band.reach() && options.distance_limit <= 1e60)) {
    if (!band.steps_aside())
      riis::fail(RIIS_INVALID_ARGUMENT, "options.distance_limit is ", options.distance_limit,
                 "; it must be from the half thickness, ", band.half_thickness, ", to 1e+60");
    riis::fail(RIIS_INVALID_ARGUMENT, "options.distance_limit is ", options.distance_limit,
               "; it must be from the reach of the band with the offset ", band.offset, ", ", band.reach(),
               ", to 1e+60");
  }
  return options.distance_limit;
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

// Returns the arrays of a list, with NULL for an empty array. The array of a field is also NULL if the field was computed only
// for K, and the caller did not request it.
riis_mark_list arrays_of(const riis::ListedNodes &list, const riis::WantedData &data) {
  const auto array = [](const auto &values) { return values.empty() ? nullptr : values.data(); };
  const auto field = [&](std::int32_t which, const auto &values) {
    return data.given_fields & which ? array(values) : nullptr;
  };
  const riis::NodeList &nodes = list.nodes;
  const riis::NodeFields &fields = list.fields;
  return {nodes.size(),
          array(nodes.node_id),
          array(nodes.distance),
          array(nodes.triangle_id),
          array(nodes.leaflet_id),
          array(list.k),
          array(list.k_u_surface),
          field(RIIS_FIELD_POINT, fields.point),
          field(RIIS_FIELD_NORMAL, fields.normal),
          field(RIIS_FIELD_BARYCENTRIC, fields.barycentric),
          field(RIIS_FIELD_UV, fields.uv),
          field(RIIS_FIELD_VELOCITY, fields.velocity),
          field(RIIS_FIELD_SIDE, fields.side),
          field(RIIS_FIELD_RIM, fields.rim),
          field(RIIS_FIELD_PATCH, fields.patch_id),
          data.n_directions,
          field(RIIS_FIELD_GRADIENT, fields.distance_gradient),
          array(list.k_gradient),
          array(fields.height)};
}

void check_n_nodes(const char *name, std::int64_t n_nodes, const riis::Marks &marks) {
  if (n_nodes != marks.stats.n_nodes)
    riis::fail(RIIS_INVALID_ARGUMENT, name, " is ", n_nodes, "; the marks are of a mesh with ", marks.stats.n_nodes,
               " nodes");
}

riis_resistance whole_of(const riis_resistance *resistance, const char *name) {
  return riis::completed(require(resistance, name), name, default_resistance);
}

riis::Resistance resistance_of(const riis_resistance *resistance, const riis::Marks &marks) {
  return riis::checked_resistance(whole_of(resistance, "resistance"), marks);
}

void check_stride(const char *name, std::int64_t stride, std::int64_t n_nodes) {
  if (stride < 1) riis::fail(RIIS_INVALID_ARGUMENT, name, " is ", stride, "; it must be at least 1");
  if (n_nodes > 0 && stride > std::numeric_limits<std::int64_t>::max() / 8 / n_nodes)
    riis::fail(RIIS_INVALID_ARGUMENT, name, " is ", stride, ": ", n_nodes,
               " entries at this stride exceed what memory can hold");
}

// Checks that all three components of a vector are given. If may_lack is true, all three components may also be NULL.
template <class Real>
void check_components(const char *name, Real *const (&components)[3], bool may_lack) {
  if (may_lack && !components[0] && !components[1] && !components[2]) return;
  for (int c = 0; c < 3; ++c)
    if (!components[c]) riis::fail(RIIS_INVALID_ARGUMENT, name, "[", c, "] is NULL");
}

// Checks an array of the caller with one entry for each node. A process without nodes may pass NULL.
const double *require_of_nodes(const double *array, const char *name, std::int64_t n_nodes) {
  return n_nodes == 0 ? array : require(array, name);
}

riis_flow_arrays checked_flow(const riis_flow_arrays *flow, const riis::Marks &marks) {
  const riis_flow_arrays whole = riis::completed(require(flow, "flow"), "flow", default_flow);
  check_n_nodes("flow.n_nodes", whole.n_nodes, marks);
  check_components("flow.velocity", whole.velocity, whole.n_nodes == 0);
  check_stride("flow.velocity_stride", whole.velocity_stride, whole.n_nodes);
  riis::check_apart(whole.n_nodes, {whole.velocity[0], whole.velocity[1], whole.velocity[2]}, whole.velocity_stride,
                    sizeof(double), {"flow.", {"velocity[0]", "velocity[1]", "velocity[2]"}, "velocity_stride"});
  require_of_nodes(whole.weight, "flow.weight", whole.n_nodes);
  return whole;
}

// Checks the fields of a reaction. The leaflets and edges of the reaction are compared with the marks later.
riis_reaction checked_reaction(const riis_reaction *reaction) {
  const riis_reaction whole = riis::completed(require(reaction, "reaction"), "reaction", default_reaction);
  for (int c = 0; c < 3; ++c)
    if (!(std::abs(whole.about[c]) <= 1e60))
      riis::fail(RIIS_INVALID_ARGUMENT, "reaction.about[", c, "] is ", whole.about[c],
                 "; it must be finite, of magnitude at most 1e+60");
  if (whole.n_leaflets < 0)
    riis::fail(RIIS_INVALID_ARGUMENT, "reaction.n_leaflets is ", whole.n_leaflets, "; it must be at least 0");
  if (whole.n_edges < 0 || whole.n_edges > (std::int64_t{1} << 40))
    riis::fail(RIIS_INVALID_ARGUMENT, "reaction.n_edges is ", whole.n_edges, "; it must be from 0 to 2^40");
  if (!whole.force && !whole.moment && !whole.leaflet_force && !whole.leaflet_moment && !whole.edge_force &&
      !whole.edge_moment)
    riis::fail(RIIS_INVALID_ARGUMENT,
               "reaction has no array to add to: force, moment and the arrays of leaflets and edges are all NULL");
  return whole;
}

riis_mark_options whole_of(const riis_mark_options *options) {
  return riis::completed(options, "options", default_mark_options);
}

riis::Threads threads_of(const riis_mark_options &options, const riis::Mesh &mesh) {
  return riis::threads_for(options.n_threads, "options.n_threads", mesh.nodes().n, riis::nodes_per_thread);
}

riis::SearchRequest request_of(const riis::Surface &surface, const riis_mesh *mesh, const riis_mark_options &options) {
  check_search(options.search);
  return {{surface, limit_of(options, surface.band()), options.node_mask, threads_of(options, mesh->mesh),
           instructions_asked_for(options.instructions)},
          mesh->mesh};
}

// Checks the three handles of a marking, the surface first, and returns the surface's content.
template <class Marks>
const riis::Surface &require_handles(const riis_surface *surface, const riis_mesh *mesh, Marks *marks) {
  const riis::Surface &content = riis::content_of(surface);
  require_handle(mesh, "mesh");
  require_handle(marks, "marks");
  return content;
}

// Returns the checked resistance of the options, or nothing if the options have no resistance.
std::optional<riis::Resistance> resistance_of(const riis::SearchRequest &request, const riis_mark_options &options) {
  if (!options.resistance) return std::nullopt;
  const riis::Resistance checked =
      riis::checked_resistance(whole_of(options.resistance, "options.resistance"), "options.resistance",
                               request.surface.band(), request.distance_limit);
  if (const riis::PatchDistance *other = request.surface.other_distance(); other && checked.cuts_rim)
    riis::fail(RIIS_INVALID_ARGUMENT, "options.resistance.rim is RIIS_RIM_CUT, but the surface's distances are by ",
               other->name(), ", which does not know the rim");
  return checked;
}

void require_edges(const riis::Mesh &mesh, const char *purpose) {
  if (!mesh.nodes().grid && !mesh.adjacency().has_value())
    riis::fail(RIIS_INVALID_ARGUMENT, "mesh has no adjacency, ", purpose, ": see riis_mesh_set_adjacency");
}

// Refuses marks of a mesh with another number of nodes. A mesh with the same number of nodes passes, even if it is a different
// mesh.
void check_are_of_mesh(const riis::Mesh &mesh, const riis::Marks &marks) {
  if (!marks.was_marked)
    riis::fail(RIIS_INVALID_ARGUMENT, "marks are empty: first call riis_mark_nodes with these marks");
  if (marks.stats.n_nodes != mesh.nodes().n)
    riis::fail(RIIS_INVALID_ARGUMENT, "marks are of a mesh with ", marks.stats.n_nodes, " nodes, mesh has ",
               mesh.nodes().n);
}

// Refuses marks of a mesh with another number of nodes, or of a surface with another half thickness. Other differences
// pass.
void check_are_of_marking(const riis::SearchRequest &request, const riis::Marks &marks) {
  require_edges(request.mesh, "which a search for leaks needs");
  check_are_of_mesh(request.mesh, marks);
  const riis::Band &now = request.surface.band();
  if (marks.band.half_thickness != now.half_thickness)
    riis::fail(RIIS_INVALID_ARGUMENT, "marks are of a surface with the half thickness ", marks.band.half_thickness,
               ", surface has ", now.half_thickness, ": mark the nodes again");
  if (marks.band.offset != now.offset)
    riis::fail(RIIS_INVALID_ARGUMENT, "marks are of a surface with the offset ", marks.band.offset, ", surface has ",
               now.offset, ": mark the nodes again");
}

// Checks the nodes of one end of a passage. `name` is the name of this end, "from" or "to".
riis::ArrayView<const std::int64_t> checked_end(const riis::SearchRequest &request, const char *name, std::int64_t n,
                                                const std::int64_t *ids) {
  const std::int64_t n_nodes = request.mesh.nodes().n;
  if (n < 1) riis::fail(RIIS_INVALID_ARGUMENT, "ends.n_", name, " is ", n, "; it must be at least 1");
  if (!ids) riis::fail(RIIS_INVALID_ARGUMENT, "ends.", name, " is NULL");
  for (std::int64_t i = 0; i < n; ++i) {
    if (ids[i] < 0 || ids[i] >= n_nodes)
      riis::fail(RIIS_INVALID_ARGUMENT, "ends.", name, "[", i, "] is ", ids[i], "; the mesh has ", n_nodes,
                 " nodes, from 0");
    if (!request.mesh.nodes().has_node(ids[i]))
      riis::fail(RIIS_INVALID_ARGUMENT, "ends.", name, "[", i, "] is ", ids[i], ", which is no node of the grid");
    if (request.is_masked_out(ids[i]))
      riis::fail(RIIS_INVALID_ARGUMENT, "ends.", name, "[", i, "] is node ", ids[i],
                 ", which options.node_mask leaves out");
  }
  return {ids, n};
}

}  // namespace

extern "C" {

riis_status riis_marks_create(riis_marks **marks) { return riis::create_handle(marks, "marks"); }

void riis_marks_destroy(riis_marks **marks) { riis::destroy_handle(marks, "marks"); }

RIIS_DEFINE_INIT(riis_resistance_init, riis_resistance, resistance, default_resistance)

RIIS_DEFINE_INIT(riis_mark_options_init, riis_mark_options, options, default_mark_options)

riis_status riis_mark_nodes(const riis_surface *surface, const riis_mesh *mesh, const riis_mark_options *options,
                            riis_marks *marks) {
  return guarded_with_handles([&] {
    const riis::Surface &content = require_handles(surface, mesh, marks);
    const riis_mark_options whole = whole_of(options);
    const riis::SearchRequest request = request_of(content, mesh, whole);
    const std::optional<riis::Resistance> resistance = resistance_of(request, whole);
    const bool lists_marked = content.band().steps_aside() && whole.distance_limit == RIIS_AUTO;
    riis::mark_nodes(
        request,
        {whole.search, whole.fields, resistance ? &*resistance : nullptr, lists_marked ? &content.band() : nullptr},
        marks->marks);
    riis::check_proportions({mesh->mesh.nodes().n_nodes(), mesh->mesh.bounds(), request.surface.scene().bounds(),
                             request.surface.half_thickness()},
                            surface->number, mesh->mesh.warned_surfaces());
  });
}

riis_status riis_marks_get_list(const riis_marks *marks, int32_t which, riis_mark_list *list, int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis::Marks &content = require_handle(marks, "marks")->marks;
    if (which != RIIS_LIST_MARKED && which != RIIS_LIST_WITHIN_LIMIT)
      riis::fail(RIIS_INVALID_ARGUMENT, "which is ", which, "; it must be one of RIIS_LIST_*");
    riis::write_struct(list, struct_size, "list",
                       arrays_of(which == RIIS_LIST_MARKED ? content.marked_list() : content.within, content.data));
  });
}

RIIS_DEFINE_INIT(riis_dense_arrays_init, riis_dense_arrays, arrays, default_dense)

riis_status riis_marks_get_dense(const riis_marks *marks, const riis_dense_arrays *arrays) {
  return guarded_with_handles([&] {
    const riis::Marks &content = require_handle(marks, "marks")->marks;
    const riis_dense_arrays to = riis::completed(require(arrays, "arrays"), "arrays", default_dense);
    check_n_nodes("arrays.n_nodes", to.n_nodes, content);
    riis::check_far_distance("arrays.far_distance", to.far_distance, content.distance_limit);
    riis::write_dense(content, to);
  });
}

riis_status riis_marks_get_stats(const riis_marks *marks, riis_mark_stats *stats, int64_t struct_size) {
  return guarded_with_handles(
      [&] { riis::write_struct(stats, struct_size, "stats", require_handle(marks, "marks")->marks.stats); });
}

RIIS_DEFINE_INIT(riis_resistance_arrays_init, riis_resistance_arrays, arrays, default_resistance_arrays)

riis_status riis_marks_add_resistance(const riis_marks *marks, const riis_resistance *resistance,
                                      const riis_resistance_arrays *arrays) {
  return guarded_with_handles([&] {
    const riis::Marks &content = require_handle(marks, "marks")->marks;
    const riis::Resistance checked = resistance_of(resistance, content);
    const riis_resistance_arrays to = riis::completed(require(arrays, "arrays"), "arrays", default_resistance_arrays);
    check_n_nodes("arrays.n_nodes", to.n_nodes, content);
    check_stride("arrays.K_stride", to.K_stride, to.n_nodes);
    check_components("arrays.K_u_surface", to.K_u_surface, true);
    check_stride("arrays.K_u_surface_stride", to.K_u_surface_stride, to.n_nodes);
    if (to.K_u_surface[0])
      riis::check_apart(
          to.n_nodes, {to.K_u_surface[0], to.K_u_surface[1], to.K_u_surface[2]}, to.K_u_surface_stride, sizeof(double),
          {"arrays.", {"K_u_surface[0]", "K_u_surface[1]", "K_u_surface[2]"}, "K_u_surface_stride"}, false);
    riis::add_resistance(content, checked, to);
  });
}

RIIS_DEFINE_INIT(riis_flow_arrays_init, riis_flow_arrays, flow, default_flow)

RIIS_DEFINE_INIT(riis_reaction_init, riis_reaction, reaction, default_reaction)

riis_status riis_marks_add_reaction(const riis_marks *marks, const riis_resistance *resistance,
                                    const riis_flow_arrays *flow, const riis_reaction *reaction) {
  return guarded_with_handles([&] {
    const riis::Marks &content = require_handle(marks, "marks")->marks;
    const riis::Resistance checked = resistance_of(resistance, content);
    const riis_flow_arrays from = checked_flow(flow, content);
    riis::add_reaction(content, checked, from, checked_reaction(reaction));
  });
}

riis_status riis_marks_add_vertex_reaction(const riis_marks *marks, const riis_surface *surface,
                                           const riis_resistance *resistance, const riis_flow_arrays *flow,
                                           int64_t n_vertices, double *vertex_force) {
  return guarded_with_handles([&] {
    const riis::Marks &content = require_handle(marks, "marks")->marks;
    const riis::TriangleSet &triangles = riis::content_of(surface).triangles();
    const riis::Resistance checked = resistance_of(resistance, content);
    const riis_flow_arrays from = checked_flow(flow, content);
    if (n_vertices != triangles.n_vertices())
      riis::fail(RIIS_INVALID_ARGUMENT, "n_vertices is ", n_vertices, "; the surface has ", triangles.n_vertices(),
                 " vertices");
    riis::add_vertex_reaction(content, triangles, checked, from, require(vertex_force, "vertex_force"));
  });
}

RIIS_DEFINE_INIT(riis_band_init, riis_band, band, default_band)

riis_status riis_marks_get_band_sums(const riis_marks *marks, const riis_band *band, riis_band_sums *sums,
                                     int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis::Marks &content = require_handle(marks, "marks")->marks;
    const riis_band whole = riis::completed(require(band, "band"), "band", default_band);
    check_n_nodes("band.n_nodes", whole.n_nodes, content);
    if (!(whole.inner >= 0 && whole.inner <= whole.outer))
      riis::fail(RIIS_INVALID_ARGUMENT, "band.inner is ", whole.inner, "; it must be from 0 to band.outer, which is ",
                 whole.outer);
    const riis::Band &around = content.band;
    if (around.steps_aside() &&
        !(whole.outer + std::abs(around.offset) * around.half_thickness <= content.distance_limit))
      riis::fail(RIIS_INVALID_ARGUMENT, "band.outer is ", whole.outer, "; with the offset ", around.offset,
                 " it must be at most ", content.distance_limit - std::abs(around.offset) * around.half_thickness,
                 ", so that the band is within the distance limit of the marking, ", content.distance_limit);
    if (!(whole.outer <= content.distance_limit))
      riis::fail(RIIS_INVALID_ARGUMENT, "band.outer is ", whole.outer,
                 "; it must be at most the distance limit of the marking, ", content.distance_limit);
    require_of_nodes(whole.value, "band.value", whole.n_nodes);
    require_of_nodes(whole.weight, "band.weight", whole.n_nodes);
    riis::write_struct(sums, struct_size, "sums", riis::band_sums(content, whole));
  });
}

riis_status riis_marks_get_cells_across(const riis_marks *marks, const riis_mesh *mesh, riis_cells_across *cells,
                                        int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis::Marks &content = require_handle(marks, "marks")->marks;
    const riis::Mesh &nodes = require_handle(mesh, "mesh")->mesh;
    riis::check_struct_size<riis_cells_across>(struct_size, "cells");
    require(cells, "cells");
    require_edges(nodes, "whose edges are measured");
    check_are_of_mesh(nodes, content);
    const int n_threads = riis::threads_for(0, nodes.nodes().n, riis::nodes_per_thread);
    riis::write_struct(cells, struct_size, "cells", riis::cells_across(content, nodes, n_threads));
  });
}

riis_status riis_leaks_create(riis_leaks **leaks) { return riis::create_handle(leaks, "leaks"); }

void riis_leaks_destroy(riis_leaks **leaks) { riis::destroy_handle(leaks, "leaks"); }

riis_status riis_find_leaks(const riis_surface *surface, const riis_mesh *mesh, const riis_marks *marks,
                            const riis_mark_options *options, riis_leaks *leaks) {
  return guarded_with_handles([&] {
    const riis::Surface &content = require_handles(surface, mesh, marks);
    require_handle(leaks, "leaks");
    const riis::SearchRequest request = request_of(content, mesh, whole_of(options));
    check_are_of_marking(request, marks->marks);
    leaks->leaks = riis::find_leaks(request, marks->marks);
  });
}

riis_status riis_leaks_get_list(const riis_leaks *leaks, riis_leak_list *list, int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis::Leaks &found = require_handle(leaks, "leaks")->leaks;
    const auto array = [](const auto &values) { return values.empty() ? nullptr : values.data(); };
    riis::write_struct(list, struct_size, "list",
                       riis_leak_list{riis::view(found.length).size(),
                                      array(found.node_id),
                                      array(found.length),
                                      array(found.distance),
                                      found.half_thickness,
                                      {found.longest_node_id[0], found.longest_node_id[1]},
                                      found.longest_length,
                                      {found.longest_middle.x, found.longest_middle.y, found.longest_middle.z},
                                      found.seconds});
  });
}

riis_status riis_label_open_regions(const riis_mesh *mesh, const riis_marks *marks, const riis_mark_options *options,
                                    int64_t n_nodes, int64_t *label, int64_t *n_regions) {
  return guarded_with_handles([&] {
    const riis::Mesh &nodes = require_handle(mesh, "mesh")->mesh;
    const riis::Marks &content = require_handle(marks, "marks")->marks;
    const riis_mark_options whole = whole_of(options);
    const int n_threads = threads_of(whole, nodes);
    require_edges(nodes, "which a search for regions needs");
    check_are_of_mesh(nodes, content);
    check_search(whole.search);
    limit_of(whole, content.band);
    instructions_asked_for(whole.instructions);
    check_n_nodes("n_nodes", n_nodes, content);
    if (n_nodes > 0) require(label, "label");
    riis::put(n_regions, riis::with_edges(nodes, [&](const auto &edges) {
                return riis::label_open_regions(edges, {nodes.nodes(), whole.node_mask, content.marked_nodes().node_id},
                                                n_threads, {label, n_nodes});
              }));
  });
}

RIIS_DEFINE_INIT(riis_passage_ends_init, riis_passage_ends, ends, default_ends)

riis_status riis_find_passage(const riis_surface *surface, const riis_mesh *mesh, const riis_passage_ends *ends,
                              const riis_mark_options *options, riis_passage *passage, int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis::Surface &content = riis::content_of(surface);
    require_handle(mesh, "mesh");
    const riis_passage_ends whole = riis::completed(require(ends, "ends"), "ends", default_ends);
    const riis::SearchRequest request = request_of(content, mesh, whole_of(options));
    riis::check_struct_size<riis_passage>(struct_size, "passage");
    require(passage, "passage");
    require_edges(request.mesh, "which a search for a passage needs");
    const riis::PassageEnds sets{checked_end(request, "from", whole.n_from, whole.from),
                                 checked_end(request, "to", whole.n_to, whole.to)};
    riis::write_struct(passage, struct_size, "passage", riis::find_passage(request, sets));
  });
}
}
