// SPDX-License-Identifier: Apache-2.0
// Calls riis_surface_get_leaflet, _orifice and _leak, riis_find_first_passage, riis_marks_get_cells_across, and
// riis_valve_get_swept_volume.
#include <algorithm>
#include <cmath>

#include "api_state.hpp"

namespace fuzz {
namespace {

// Returns a struct of bytes 0x5a. A refused call must not change this struct.
template <class Struct>
Struct filled() {
  Struct made;
  std::memset(static_cast<void *>(&made), 0x5a, sizeof made);
  return made;
}

template <class Struct>
bool is_untouched(const Struct &result) {
  const auto *bytes = reinterpret_cast<const unsigned char *>(&result);
  return std::all_of(bytes, bytes + sizeof result, [](unsigned char byte) { return byte == 0x5a; });
}

riis_resistance resistance_of(Input &in) {
  riis_resistance resistance = initialised(in, riis_resistance_init);
  resistance.R = in.one_in(4) ? in.number() : 100;
  if (in.one_in(4)) resistance.half_thickness = in.number();
  resistance.rim = in.mostly(in.below(2));
  resistance.reserved = in.one_in(64) ? 1 : 0;
  return resistance;
}

void read_leaflets(Input &in, const riis_surface *surface, bool is_right) {
  std::int64_t n_leaflets = -7;
  riis_status status = call(in, [&] { return riis_surface_get_n_leaflets(surface, &n_leaflets); });
  EXPECT((status == RIIS_OK) == is_right && (is_right ? n_leaflets > 0 : n_leaflets == -7), "%d", status);
  const std::int64_t leaflet = in.mostly<std::int64_t>(n_leaflets > 0 ? in.byte() % n_leaflets : 0);
  auto sizes = filled<riis_leaflet>();
  const std::int64_t size = in.mostly<std::int64_t>(sizeof sizes);
  status = call(in, [&] { return riis_surface_get_leaflet(surface, leaflet, mostly(in, &sizes), size); });
  if (status != RIIS_OK) {
    EXPECT(is_untouched(sizes), "a refused leaflet was written");
    return;
  }
  EXPECT(is_right && leaflet >= 0 && leaflet < n_leaflets, "leaflet %lld", static_cast<long long>(leaflet));
  EXPECT(sizes.n_triangles > 0 && sizes.area >= 0 && sizes.free_edge >= 0, "area %g", sizes.area);
}

void read_orifice(Input &in, const riis_surface *surface, bool is_right) {
  const riis_resistance resistance = resistance_of(in);
  auto orifice = filled<riis_orifice>();
  const std::int64_t size = in.mostly<std::int64_t>(sizeof orifice);
  const bool has_wall = in.one_in(3);
  const riis_status status = call(in, [&] {
    if (has_wall)
      return riis_surface_get_orifice_in_wall(surface, surface, in.one_in(2) ? &resistance : nullptr,
                                              mostly(in, &orifice), size);
    return riis_surface_get_orifice(surface, in.one_in(2) ? &resistance : nullptr, mostly(in, &orifice), size);
  });
  if (status != RIIS_OK) {
    EXPECT(is_untouched(orifice), "a refused orifice was written");
    return;
  }
  EXPECT(is_right, "an orifice of nothing");
  const double most = orifice.outline_area * (1 + 1e-6);
  EXPECT(orifice.effective_area >= 0 && orifice.effective_area <= most, "effective area %g", orifice.effective_area);
  EXPECT(orifice.area >= 0 && orifice.area <= most && orifice.perimeter >= 0, "area %g of %g", orifice.area, most);
}

void read_leak(Input &in, const riis_surface *surface, bool is_right) {
  const riis_resistance resistance = resistance_of(in);
  const double drop = in.number();
  double flow = -7;
  const riis_status status =
      call(in, [&] { return riis_surface_get_leak(surface, mostly(in, &resistance), drop, mostly(in, &flow)); });
  if (status == RIIS_OK)
    EXPECT(is_right && resistance.R > 0 && std::isfinite(flow) && flow * drop >= 0, "flow %g", flow);
  else
    EXPECT(flow == -7, "a refused leak was written");
}

}  // namespace

void measure_surface(Input &in, State &state) {
  const Given<riis_surface> surface = given(in, state, State::surface, state.surfaces[in.slot()]);
  read_leaflets(in, surface.handle, surface.is_right);
  read_orifice(in, surface.handle, surface.is_right);
  read_leak(in, surface.handle, surface.is_right);
}

void measure_marks(Input &in, State &state) {
  const ResultSlot &slot = state.results[in.slot()];
  const MeshSlot &mesh_slot = state.meshes[in.slot()];
  const Given<riis_marks> marks = given(in, state, State::result, slot.handle);
  const Given<riis_mesh> mesh = given(in, state, State::mesh, mesh_slot.handle);
  auto cells = filled<riis_cells_across>();
  const std::int64_t size = in.mostly<std::int64_t>(sizeof cells);
  const riis_status status =
      call(in, [&] { return riis_marks_get_cells_across(marks.handle, mesh.handle, mostly(in, &cells), size); });
  if (status != RIIS_OK) {
    EXPECT(is_untouched(cells), "refused cells were written");
    return;
  }
  EXPECT(marks.is_right && mesh.is_right && mesh_slot.adjacency, "cells across nothing");
  EXPECT(cells.n_edges >= 0 && cells.least <= cells.most, "%g to %g", cells.least, cells.most);
  EXPECT(cells.shortest_edge <= cells.longest_edge, "%g to %g", cells.shortest_edge, cells.longest_edge);
}

void measure_valve(Input &in, State &state) {
  const Given<riis_valve> valve = given(in, state, State::valve, state.valves[in.slot()].handle);
  riis_surface_options options = initialised(in, riis_surface_options_init);
  options.flip_normals = in.mostly(in.below(2));
  options.n_threads = in.n_threads();
  const double from = in.one_in(8) ? in.number() : in.below(9) / 8.0, to = in.one_in(8) ? in.number() : 0.5;
  const std::int32_t leaflet = in.mostly(in.below(4) - 1);
  double volume = -7;
  riis_status status = call(in, [&] {
    return riis_valve_get_swept_volume(valve.handle, from, to, in.one_in(2) ? &options : nullptr, leaflet, &volume);
  });
  if (!valve.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status == RIIS_OK)
    EXPECT(std::isfinite(volume) && from >= 0 && from <= 1 && to >= 0 && to <= 1, "volume %g", volume);
  else
    EXPECT(volume == -7, "a refused volume was written");

  // Each trial makes a surface. The surfaces are therefore coarse, and the trials are few.
  const MeshSlot &mesh_slot = state.meshes[in.slot()];
  const Given<riis_mesh> mesh = given(in, state, State::mesh, mesh_slot.handle);
  options.tolerance = 1;
  options.half_thickness = in.one_in(8) ? 2 : 0.5;
  riis_first_passage_options trials = initialised(in, riis_first_passage_options_init);
  trials.surface = &options;
  trials.tolerance = in.one_in(8) ? in.number() : 0.1;
  if (trials.tolerance < 1e-2 && trials.tolerance >= 1e-6) trials.tolerance = 1e-2;
  const std::int64_t n_nodes = mesh_slot.handle ? mesh_slot.nodes->n : 1;
  const std::int64_t from_node = in.mostly<std::int64_t>(0), to_node = in.mostly<std::int64_t>(n_nodes - 1);
  riis_passage_ends ends = initialised(in, riis_passage_ends_init);
  ends.n_from = ends.n_to = in.one_in(32) ? 0 : 1;
  ends.from = mostly(in, &from_node);
  ends.to = mostly(in, &to_node);
  auto first = filled<riis_first_passage>();
  const std::int64_t size = in.mostly<std::int64_t>(sizeof first);
  status = call(in, [&] {
    return riis_find_first_passage(valve.handle, mesh.handle, mostly(in, &ends), &trials, mostly(in, &first), size);
  });
  if (status != RIIS_OK) {
    EXPECT(is_untouched(first), "a refused first passage was written");
    return;
  }
  EXPECT(valve.is_right && mesh.is_right && mesh_slot.adjacency, "a passage through nothing");
  EXPECT(
      first.closed_opening >= 0 && first.closed_opening <= first.opening && first.opening <= 1 && first.n_openings > 0,
      "%g to %g", first.closed_opening, first.opening);
  if (first.state == RIIS_FIRST_PASSAGE_FOUND)
    EXPECT(first.opening - first.closed_opening <= trials.tolerance, "%g to %g", first.closed_opening, first.opening);
}

}  // namespace fuzz
