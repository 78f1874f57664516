// SPDX-License-Identifier: Apache-2.0
// This header has the handles of a sequence of calls, the memory that the handles borrow, and the functions that make the calls.
// The floating-point environment differs between calls. After each call, the harness checks the promises that hold for all calls.
#pragma once

#include <riis/riis.h>

#include <array>
#include <cfenv>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "../support/calls.h"
#include "input.hpp"

namespace fuzz {

// The parts of the floating-point environment that a caller would notice.
struct FloatSettings {
  int rounding = std::fegetround(), traps = fegetexcept(), raised = std::fetestexcept(FE_ALL_EXCEPT);
#if defined(__SSE__)
  unsigned int sse = _mm_getcsr();
#endif
  bool operator==(const FloatSettings &other) const {
#if defined(__SSE__)
    if (sse != other.sse) return false;
#endif
    return rounding == other.rounding && traps == other.traps && raised == other.raised;
  }
};

inline void set_float_environment(int choice) {
  std::fesetenv(FE_DFL_ENV);
  if (choice == 1) std::fesetround(FE_UPWARD);
  if (choice == 2) std::fesetround(FE_TOWARDZERO);
  if (choice == 3) feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
#if defined(__SSE__)
  if (choice == 4) _mm_setcsr(_mm_getcsr() | 0x8040);  // sets "flush to zero" and "denormals are zero"
#endif
}

inline void check_status(riis_status status, const std::string &text_before) {
  const char *text = riis_last_error();
  EXPECT(text != nullptr, "after status %d", status);
  if (status == RIIS_OK) {
    EXPECT(text == text_before, "a successful call changed the text of the last error to '%s'", text);
    return;
  }
  // A call returns RIIS_UNAVAILABLE for instructions that this processor lacks.
  EXPECT((status >= RIIS_INVALID_ARGUMENT && status <= RIIS_OUT_OF_MEMORY) || status == RIIS_UNAVAILABLE,
         "status %d: %s", status, text);
  EXPECT(std::strcmp(riis_status_name(status), "unknown status") != 0, "status %d", status);
  EXPECT(std::strlen(text) > 8 && std::strlen(text) < 512, "status %d has the text '%s'", status, text);
}

// Makes the call and returns its status, which must be RIIS_OK or a refusal with a message.
template <class Call>
riis_status call(Input &in, const Call &make_call) {
  const std::string text_before = riis_last_error();
  const int environment = in.byte();
  set_float_environment(environment < 192 ? 0 : environment % 5);
  const FloatSettings before;
  const riis_status status = make_call();
  const FloatSettings after;
  std::fesetenv(FE_DFL_ENV);
  EXPECT(before == after, "the floating-point environment %d changed", environment);
  check_status(status, text_before);
  return status;
}

// Makes a call that must succeed in any state, even with little memory.
#define EXPECT_OK(call_)                                                                \
  do {                                                                                  \
    const riis_status status_ = (call_);                                                \
    EXPECT(status_ == RIIS_OK, "%s: %s", riis_status_name(status_), riis_last_error()); \
  } while (0)

// Makes a call that creates an object. The call must write the handle if it succeeds, and only then.
template <class Handle, class Make>
Handle *made_by(Input &in, const Make &make) {
  auto *const untouched = reinterpret_cast<Handle *>(0x5a5a5a5a5a5a5a50);
  Handle *handle = untouched;
  const bool into_nothing = in.one_in(64);
  const riis_status status = call(in, [&] { return make(into_nothing ? nullptr : &handle); });
  EXPECT((status == RIIS_OK) == (handle != untouched), "status %d", status);
  EXPECT(handle != nullptr, "status %d", status);
  return status == RIIS_OK ? handle : nullptr;
}

// Returns an option struct that its init function filled. Sometimes its size is wrong.
template <class Struct>
Struct initialised(Input &in, riis_status (*init)(Struct *, int64_t)) {
  Struct made;
  EXPECT_OK(init(&made, sizeof made));
  static const int64_t wrong[] = {0, 8, -8, 1, sizeof(Struct) - 8, sizeof(Struct) + 8, sizeof(Struct) + 1, INT64_MAX};
  if (in.one_in(48)) made.struct_size = in.one_of(wrong);
  return made;
}

constexpr int n_slots = 3;

// An adjacency that the library made. Meshes that borrow the adjacency keep it alive.
struct OwnedAdjacency {
  riis_adjacency *handle = nullptr;
  explicit OwnedAdjacency(riis_adjacency *made) : handle(made) {}
  OwnedAdjacency(const OwnedAdjacency &) = delete;
  OwnedAdjacency &operator=(const OwnedAdjacency &) = delete;
  ~OwnedAdjacency() { riis_adjacency_destroy(&handle); }
};

// Coordinates in one of several layouts. The buffer ends with the last coordinate.
struct Nodes {
  std::int64_t n = 0, stride = 1;
  std::vector<double> buffer;
  const double *x = nullptr, *y = nullptr, *z = nullptr;
  std::array<double, 3> operator[](std::int64_t i) const { return {x[i * stride], y[i * stride], z[i * stride]}; }
};

// A mesh and all memory that its handle borrows.
struct MeshSlot {
  riis_mesh *handle = nullptr;
  std::shared_ptr<Nodes> nodes;
  std::shared_ptr<void> adjacency;  // the memory of the rows; empty if the mesh has no adjacency
  bool was_told = true;             // whether the handle was updated after the last change of coordinates
};

struct ValveSlot {
  riis_valve *handle = nullptr;
  double size = 1;  // for a valve from patches: the extent of its control points
};

struct ResultSlot {
  riis_marks *handle = nullptr;
  double distance_limit = 0;  // the limit of the last marking
};

struct State {
  std::array<ValveSlot, n_slots> valves;
  std::array<riis_surface *, n_slots> surfaces{};
  std::array<MeshSlot, n_slots> meshes;
  std::array<std::shared_ptr<OwnedAdjacency>, n_slots> adjacencies;
  std::array<ResultSlot, n_slots> results;
  std::array<riis_leaks *, n_slots> leaks{};
  std::array<riis_crossings *, n_slots> crossings{};

  State() = default;
  State(const State &) = delete;
  State &operator=(const State &) = delete;
  ~State();

  // Returns a handle of another kind than the given handle, so that a call gets a wrong handle. Returns NULL if no such handle
  // exists.
  enum Kind { valve, surface, mesh, adjacency, result, leak, crossing, n_kinds };
  void *handle_of_another_kind(Input &in, Kind but) const;
};

// Returns the right handle. Sometimes returns NULL or a handle of another kind. `is_right` tells whether the handle is right.
template <class Handle>
struct Given {
  Handle *handle;
  bool is_right;
};
template <class Handle>
Given<Handle> given(Input &in, const State &state, State::Kind kind, Handle *right) {
  const int choice = in.below(32);
  if (choice == 31) return {static_cast<Handle *>(state.handle_of_another_kind(in, kind)), false};
  if (choice == 30) return {nullptr, false};
  return {right, right != nullptr};
}

// Each function makes some calls. The input decides the details.
void call_status_functions(Input &in);
void call_init_functions(Input &in);
void make_valve(Input &in, State &state);
void make_valve_of_patches(Input &in, State &state);
void set_parameter(Input &in, State &state);
void read_parameters(Input &in, State &state);
void place_valve(Input &in, State &state);
void warp_valve(Input &in, State &state);
void set_open_state(Input &in, State &state);
void make_surface(Input &in, State &state);
void move_surface(Input &in, State &state);
void make_surface_of_arrays(Input &in, State &state);
void read_surface(Input &in, State &state);
void ask_closest_point(Input &in, State &state);
void ask_closest_points(Input &in, State &state);
void make_mesh(Input &in, State &state);
void move_mesh(Input &in, State &state);
void prepare_mesh(Input &in, State &state);
void give_rows(Input &in, State &state);
void give_adjacency(Input &in, State &state);
void make_adjacency_of_cells(Input &in, State &state);
void make_adjacency_of_faces(Input &in, State &state);
void make_adjacency_of_grid(Input &in, State &state);
void mark(Input &in, State &state);
void read_marks(Input &in, State &state);
void find_leaks(Input &in, State &state);
void find_crossings(Input &in, State &state);
void label_regions(Input &in, State &state);
void find_passage(Input &in, State &state);
void destroy_something(Input &in, State &state);
void add_forces(Input &in, State &state);
void measure_surface(Input &in, State &state);
void measure_marks(Input &in, State &state);
void measure_valve(Input &in, State &state);
void advance_laws(Input &in, State &state);
void move_by_keyframes(Input &in, State &state);

// The closest triangle and its distance, as found by a loop over all triangles. The position is -1 if no triangle is within the
// limit.
struct Closest {
  double distance;
  std::int64_t triangle;
};
// Returns whether the surface reports that it measures distances to triangles.
bool is_by_triangles(const riis_surface *surface);
Closest closest_by_loop(const riis_triangles &triangles, const std::array<double, 3> &point);
// Returns whether n_points loops over all triangles are fast enough.
inline bool is_small(const riis_triangles &triangles, std::int64_t n_points) {
  return triangles.n_triangles * n_points <= 60'000;
}

}  // namespace fuzz
