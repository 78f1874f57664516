// SPDX-License-Identifier: Apache-2.0
// Every struct is passed with its size, so that callers compiled against an older header keep working. If the caller's header
// lacks a field, the library reads the field's default. The library does not write such a field.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "base/errors.hpp"
#include "parallel/parallel_for.hpp"
#include "parallel/threads.hpp"

namespace riis {

const riis_points default_points{sizeof(riis_points), 0, nullptr, nullptr, nullptr, 1, 64, 0};

// The size of the struct in the first release that contained it.
constexpr std::int64_t first_size_of(const riis_points *) { return 56; }
constexpr std::int64_t first_size_of(const riis_patches *) { return 72; }
constexpr std::int64_t first_size_of(const riis_parameter *) { return 72; }
constexpr std::int64_t first_size_of(const riis_surface_options *) { return 120; }
constexpr std::int64_t first_size_of(const riis_surface_arrays *) { return 120; }
constexpr std::int64_t first_size_of(const riis_keyframe_arrays *) { return 56; }
constexpr std::int64_t first_size_of(const riis_surface_info *) { return 120; }
constexpr std::int64_t first_size_of(const riis_triangles *) { return 72; }
constexpr std::int64_t first_size_of(const riis_attachment *) { return 40; }
constexpr std::int64_t first_size_of(const riis_warp_options *) { return 24; }
constexpr std::int64_t first_size_of(const riis_warp_info *) { return 80; }
constexpr std::int64_t first_size_of(const riis_valve_patches *) { return 96; }
constexpr std::int64_t first_size_of(const riis_crossing_options *) { return 24; }
constexpr std::int64_t first_size_of(const riis_crossing_list *) { return 112; }
constexpr std::int64_t first_size_of(const riis_closest *) { return 96; }
constexpr std::int64_t first_size_of(const riis_closest_options *) { return 56; }
constexpr std::int64_t first_size_of(const riis_closest_arrays *) { return 64; }
constexpr std::int64_t first_size_of(const riis_grid *) { return 152; }
constexpr std::int64_t first_size_of(const riis_csr *) { return 56; }
constexpr std::int64_t first_size_of(const riis_mesh_cells *) { return 56; }
constexpr std::int64_t first_size_of(const riis_mesh_faces *) { return 64; }
constexpr std::int64_t first_size_of(const riis_resistance *) { return 32; }
constexpr std::int64_t first_size_of(const riis_mark_options *) { return 48; }
constexpr std::int64_t first_size_of(const riis_mark_list *) { return 120; }
constexpr std::int64_t first_size_of(const riis_dense_arrays *) { return 56; }
constexpr std::int64_t first_size_of(const riis_mark_stats *) { return 64; }
constexpr std::int64_t first_size_of(const riis_resistance_arrays *) { return 64; }
constexpr std::int64_t first_size_of(const riis_flow_arrays *) { return 56; }
constexpr std::int64_t first_size_of(const riis_reaction *) { return 112; }
constexpr std::int64_t first_size_of(const riis_loads *) { return 96; }
constexpr std::int64_t first_size_of(const riis_band_sums *) { return 48; }
constexpr std::int64_t first_size_of(const riis_band *) { return 48; }
constexpr std::int64_t first_size_of(const riis_leak_list *) { return 96; }
constexpr std::int64_t first_size_of(const riis_passage *) { return 56; }
constexpr std::int64_t first_size_of(const riis_passage_ends *) { return 40; }
constexpr std::int64_t first_size_of(const riis_leaflet *) { return 32; }
constexpr std::int64_t first_size_of(const riis_orifice *) { return 88; }
constexpr std::int64_t first_size_of(const riis_area_search *) { return 56; }
constexpr std::int64_t first_size_of(const riis_area_range *) { return 112; }
constexpr std::int64_t first_size_of(const riis_first_passage_options *) { return 32; }
constexpr std::int64_t first_size_of(const riis_first_passage *) { return 72; }
constexpr std::int64_t first_size_of(const riis_cells_across *) { return 64; }
constexpr std::int64_t first_size_of(const riis_landmarks *) { return 112; }
constexpr std::int64_t first_size_of(const riis_placement *) { return 120; }
constexpr std::int64_t first_size_of(const riis_placement_arrays *) { return 32; }
constexpr std::int64_t first_size_of(const riis_opening_table *) { return 48; }
constexpr std::int64_t first_size_of(const riis_opening_times *) { return 64; }
constexpr std::int64_t first_size_of(const riis_opening_switch *) { return 56; }
constexpr std::int64_t first_size_of(const riis_opening_switch_state *) { return 72; }
constexpr std::int64_t first_size_of(const riis_opening_angle *) { return 56; }
constexpr std::int64_t first_size_of(const riis_opening_angle_state *) { return 64; }
constexpr std::int64_t first_size_of(const riis_coaptation *) { return 24; }
constexpr std::int64_t first_size_of(const riis_gap *) { return 64; }
constexpr std::int64_t first_size_of(const riis_direction *) { return 24; }

// Refuses a wrong size of a struct. The size must be a multiple of 8, at least the size in the first release, and at most the
// library's own size.
template <class Struct>
void check_struct_size(std::int64_t size, const char *name) {
  static_assert(std::is_trivially_copyable_v<Struct> && sizeof(Struct) % 8 == 0);
  constexpr std::int64_t size_here = sizeof(Struct), first_size = first_size_of(static_cast<Struct *>(nullptr));
  static_assert(first_size <= size_here);
  if (size < first_size || size > size_here || size % 8 != 0)
    fail(RIIS_INVALID_STRUCT_SIZE, "the struct size of ", name, " is ", size, "; riis ", riis_version_string(),
         " knows ", first_size, " to ", size_here, ": use its init function, and a header no newer than the library");
}

// Copies the first `size` bytes of a struct. First call check_struct_size, which must accept the size.
inline void copy_bytes(void *to, const void *from, std::int64_t size) {
  std::memcpy(to, from, static_cast<std::size_t>(size));
}

// The body of an init function.
template <class Struct>
riis_status init_struct(Struct *out, std::int64_t size, const char *name, const Struct &defaults) noexcept {
  return guarded([&] {
    require(out, name);
    check_struct_size<Struct>(size, name);
    copy_bytes(out, &defaults, size);
    out->struct_size = size;
  });
}

// Defines the public init function of a struct. `argument` is the argument's name in messages.
#define RIIS_DEFINE_INIT(function, Struct, argument, defaults)            \
  riis_status function(Struct *argument, int64_t struct_size) {           \
    return riis::init_struct(argument, struct_size, #argument, defaults); \
  }

// Returns the caller's struct, with defaults for the fields that its size leaves out. Returns all defaults for NULL.
template <class Struct>
Struct completed(const Struct *in, const char *name, const Struct &defaults) {
  Struct whole = defaults;
  if (in) {
    check_struct_size<Struct>(in->struct_size, name);
    copy_bytes(&whole, in, in->struct_size);
  }
  whole.struct_size = sizeof(Struct);
  return whole;
}

// Writes those fields of the value that the caller's struct has.
template <class Struct>
void write_struct(Struct *out, std::int64_t size, const char *name, const Struct &value) {
  require(out, name);
  check_struct_size<Struct>(size, name);
  copy_bytes(out, &value, size);
}

// Writes an output if the caller's pointer is not null.
template <class T>
void put(T *to, T value) {
  if (to) *to = value;
}

// Refuses a far_distance that could be mistaken for a distance within the limit.
inline void check_far_distance(const char *name, double far_distance, double distance_limit) {
  if (far_distance >= 0 && far_distance <= distance_limit)
    fail(RIIS_INVALID_ARGUMENT, name, " is ", far_distance, "; it must not lie between 0 and the distance limit ",
         distance_limit);
}

inline void check_threads(std::int32_t n_threads, const char *name) {
  if (n_threads < 0 || n_threads > 1024)
    fail(RIIS_INVALID_ARGUMENT, name, " is ", n_threads, "; it must be from 1 to 1024, or 0 for the default");
  if (n_threads > 1 && has_lost_threads())
    fail(RIIS_UNAVAILABLE, name, " is ", n_threads,
         "; this process was forked after riis had used several threads, so it may use only 1 thread");
}

// Checks the caller's n_threads, and returns the threads to use. 0 stands for the default.
inline Threads threads_for(std::int32_t n_threads, const char *name, std::int64_t n_items, std::int64_t per_thread) {
  check_threads(n_threads, name);
  return threads_for(n_threads, n_items, per_thread);
}

}  // namespace riis
