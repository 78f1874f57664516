// SPDX-License-Identifier: Apache-2.0
// Fuzzes the C interface. The input is a sequence of calls with right and wrong arguments, on a few handles of each kind. After
// every call, the harness checks the promises that the header makes for all calls. The harness also checks results that it can
// compute in another way.
#include <cstdio>

#include "api_state.hpp"

namespace fuzz {

State::~State() {
  for (riis_leaks *&found : leaks) riis_leaks_destroy(&found);
  for (riis_crossings *&found : crossings) riis_crossings_destroy(&found);
  for (ResultSlot &slot : results) riis_marks_destroy(&slot.handle);
  for (MeshSlot &slot : meshes) riis_mesh_destroy(&slot.handle);
  for (riis_surface *&surface : surfaces) riis_surface_destroy(&surface);
  for (ValveSlot &slot : valves) riis_valve_destroy(&slot.handle);
}

void *State::handle_of_another_kind(Input &in, Kind but) const {
  const auto kind = static_cast<Kind>((static_cast<int>(but) + 1 + in.below(n_kinds - 1)) % n_kinds);
  const auto i = in.slot();
  switch (kind) {
    case valve:
      return valves[i].handle;
    case surface:
      return surfaces[i];
    case mesh:
      return meshes[i].handle;
    case adjacency:
      return adjacencies[i] ? adjacencies[i]->handle : nullptr;
    case result:
      return results[i].handle;
    case leak:
      return leaks[i];
    default:
      return crossings[i];
  }
}

void call_status_functions(Input &in) {
  const auto status = in.raw<riis_status>();
  EXPECT(riis_status_name(status) != nullptr, "%d", status);
  EXPECT(riis_version_string() != nullptr, "no version");
  EXPECT(riis_status_name(in.below(16) - 2)[0] != '\0', "no name");
}

namespace {

// Checks that an init function fills exactly the caller's struct, or writes nothing.
template <class Struct>
void init(Input &in, riis_status (*init_function)(Struct *, int64_t)) {
  static const int64_t sizes[] = {sizeof(Struct),     0,         8,        -8, sizeof(Struct) - 8, sizeof(Struct) + 8,
                                  sizeof(Struct) + 1, INT64_MAX, INT64_MIN};
  const int64_t size = in.one_of(sizes);
  // The struct is on the heap, so that the sanitizer detects writes beyond its end.
  const auto out = std::make_unique<Struct>();
  std::memset(static_cast<void *>(out.get()), 0x5a, sizeof(Struct));
  const bool into_nothing = in.one_in(8);
  const riis_status status = call(in, [&] { return init_function(into_nothing ? nullptr : out.get(), size); });
  EXPECT(status == RIIS_OK || status == (into_nothing ? RIIS_INVALID_ARGUMENT : RIIS_INVALID_STRUCT_SIZE), "%d",
         status);
  const auto *bytes = reinterpret_cast<const unsigned char *>(out.get());
  const std::size_t n_written = status == RIIS_OK ? static_cast<std::size_t>(size) : 0;
  for (std::size_t i = n_written; i < sizeof(Struct); ++i) EXPECT(bytes[i] == 0x5a, "byte %zu was written", i);
  if (status == RIIS_OK) EXPECT(out->struct_size == size, "%lld", static_cast<long long>(out->struct_size));
}

}  // namespace

void call_init_functions(Input &in) {
  switch (in.below(18)) {
    case 0:
      return init(in, riis_patches_init);
    case 1:
      return init(in, riis_surface_options_init);
    case 2:
      return init(in, riis_surface_arrays_init);
    case 3:
      return init(in, riis_closest_options_init);
    case 4:
      return init(in, riis_closest_arrays_init);
    case 5:
      return init(in, riis_csr_init);
    case 6:
      return init(in, riis_mesh_cells_init);
    case 7:
      return init(in, riis_resistance_init);
    case 8:
      return init(in, riis_keyframe_arrays_init);
    case 9:
      return init(in, riis_opening_table_init);
    case 10:
      return init(in, riis_opening_times_init);
    case 11:
      return in.one_in(2) ? init(in, riis_opening_switch_init) : init(in, riis_opening_switch_state_init);
    case 12:
      return in.one_in(2) ? init(in, riis_opening_angle_init) : init(in, riis_opening_angle_state_init);
    case 13:
      return in.one_in(2) ? init(in, riis_points_init) : init(in, riis_dense_arrays_init);
    case 14:
      return in.one_in(2) ? init(in, riis_resistance_arrays_init) : init(in, riis_flow_arrays_init);
    case 15:
      return in.one_in(2) ? init(in, riis_band_init) : init(in, riis_passage_ends_init);
    case 16:
      return init(in, riis_crossing_options_init);
    default:
      return in.one_in(2) ? init(in, riis_mesh_faces_init) : init(in, riis_mark_options_init);
  }
}

namespace {

template <class Handle>
void destroy(Input &in, const State &state, State::Kind kind, void (*destroy_function)(Handle **), Handle *&handle) {
  destroy_function(nullptr);
  if (auto *other = static_cast<Handle *>(state.handle_of_another_kind(in, kind))) {
    Handle *const before = other;
    destroy_function(&other);
    EXPECT(other == before, "a handle of another kind was destroyed as one of kind %d", kind);
  }
  destroy_function(&handle);
  EXPECT(handle == nullptr, "a destroyed handle of kind %d is not NULL", kind);
}

}  // namespace

void destroy_something(Input &in, State &state) {
  const auto i = in.slot();
  switch (in.below(State::n_kinds)) {
    case State::valve:
      return destroy(in, state, State::valve, riis_valve_destroy, state.valves[i].handle);
    case State::surface:
      return destroy(in, state, State::surface, riis_surface_destroy, state.surfaces[i]);
    case State::mesh:
      destroy(in, state, State::mesh, riis_mesh_destroy, state.meshes[i].handle);
      state.meshes[i] = {};
      return;
    case State::adjacency:
      state.adjacencies[i].reset();
      return;
    case State::leak:
      return destroy(in, state, State::leak, riis_leaks_destroy, state.leaks[i]);
    case State::crossing:
      return destroy(in, state, State::crossing, riis_crossings_destroy, state.crossings[i]);
    default:
      destroy(in, state, State::result, riis_marks_destroy, state.results[i].handle);
      state.results[i] = {};
      return;
  }
}

namespace {

// If all bytes of an input are 0, every choice is 0. The calls of this list are then made in order, and all succeed.
void (*const calls[])(Input &, State &) = {make_valve,
                                           make_surface,
                                           make_mesh,
                                           give_rows,
                                           mark,
                                           move_mesh,
                                           prepare_mesh,
                                           mark,
                                           set_parameter,
                                           make_surface,
                                           mark,
                                           move_surface,
                                           mark,
                                           add_forces,
                                           make_surface_of_arrays,
                                           mark,
                                           make_adjacency_of_cells,
                                           give_adjacency,
                                           mark,
                                           make_valve_of_patches,
                                           set_open_state,
                                           make_surface,
                                           mark,
                                           make_adjacency_of_faces,
                                           give_adjacency,
                                           mark,
                                           find_leaks,
                                           label_regions,
                                           find_passage,
                                           read_marks,
                                           make_adjacency_of_grid,
                                           give_adjacency,
                                           mark,
                                           read_parameters,
                                           read_surface,
                                           ask_closest_point,
                                           ask_closest_points,
                                           advance_laws,
                                           move_by_keyframes,
                                           find_crossings,
                                           measure_surface,
                                           measure_marks,
                                           measure_valve,
                                           destroy_something,
                                           [](Input &in, State &) { call_status_functions(in); },
                                           [](Input &in, State &) { call_init_functions(in); },
                                           place_valve,
                                           warp_valve};

void log_nothing(void *, std::int32_t level, const char *message) {
  EXPECT(message != nullptr && message[0] != '\0', "level %d", level);
}

}  // namespace
}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, std::size_t size) {
  fuzz::Input in(bytes, size);
  fuzz::State state;
  riis_set_log(in.one_in(4) ? fuzz::log_nothing : nullptr, nullptr);
  constexpr int n_calls = static_cast<int>(sizeof fuzz::calls / sizeof *fuzz::calls);
  for (int i = 0; i < 48 && !in.is_used_up(); ++i) fuzz::calls[(in.byte() + i) % n_calls](in, state);
  return 0;
}
