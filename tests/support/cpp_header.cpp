// SPDX-License-Identifier: Apache-2.0
#include "cpp_header.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <riis/riis.hpp>
#include <type_traits>
#include <utility>

namespace {

template <class Struct>
bool is_by_init(riis_status (*init)(Struct *, std::int64_t)) {
  Struct expected;
  const Struct made = riis::defaults<Struct>();
  return init(&expected, sizeof expected) == RIIS_OK && std::memcmp(&expected, &made, sizeof made) == 0;
}

riis::Valve new_valve() {
  riis::Valve valve;
  riis::check(riis_valve_create("aortic", valve.out()));
  return valve;
}

}  // namespace

std::int64_t cpp_mark(std::int64_t n, const double *xyz, double half_thickness, std::int64_t *node_id) try {
  riis::Valve valve;
  riis::Surface surface;
  riis::Mesh mesh;
  riis::Marks marks;
  riis::check(riis_valve_create("mitral", valve.out()));
  auto options = riis::defaults<riis_surface_options>();
  options.half_thickness = half_thickness;
  riis::check(riis_surface_create(valve, &options, surface.out()));
  riis::check(riis_mesh_create(n, xyz, xyz + 1, xyz + 2, 3, mesh.out()));
  riis::check(riis_marks_create(marks.out()));
  riis::check(riis_mark_nodes(surface, mesh, nullptr, marks));
  const auto marked = riis::get<riis_mark_list>(riis_marks_get_list, marks, RIIS_LIST_MARKED);
  for (const std::int64_t node : riis::Span(marked.node_id, marked.n_nodes)) *node_id++ = node;
  const auto info = riis::get<riis_surface_info>(riis_surface_get_info, surface);
  return info.half_thickness == half_thickness ? marked.n_nodes : -1;
} catch (const riis::Error &) {
  return -1;
}

std::int32_t cpp_refusal(const char *kind, char *text, std::size_t length) {
  try {
    riis::Valve valve;
    riis::check(riis_valve_create(kind, valve.out()));
    return RIIS_OK;
  } catch (const std::runtime_error &error) {
    std::snprintf(text, length, "%s", error.what());
    return static_cast<const riis::Error &>(error).status();
  }
}

const char *cpp_wrong_with_handles() {
  static_assert(!std::is_copy_constructible_v<riis::Marks> && std::is_nothrow_move_constructible_v<riis::Marks> &&
                std::is_nothrow_move_assignable_v<riis::Marks>);
  static_assert(!std::is_convertible_v<riis_valve *, riis::Valve>);
  static_assert(std::is_convertible_v<const riis::Valve &, const riis_valve *>);
  static_assert(!std::is_convertible_v<const riis::Valve &, const riis_mesh *>);
  riis::Valve valve = new_valve();
  riis_valve *const first = valve;
  if (!first || valve.get() != first) return "a handle has no object";
  riis::Valve other = std::move(valve);
  if (valve.get() || other.get() != first) return "the object did not move";
  other = riis::Valve(new_valve());
  if (!other.get()) return "a handle that was assigned has no object";
  riis::Valve &same = other;
  other = std::move(same);
  if (!other.get()) return "a handle that was moved into itself lost its object";
  riis_valve *released = other.release();
  if (other.get()) return "a released object is still there";
  valve.reset(released);
  if (valve.get() != released) return "a handle did not take the object over";
  if (*valve.out() || valve.get()) return "out() did not destroy the object";
  return "";
}

const char *cpp_wrong_with_defaults() {
#define SAME(name) \
  if (!is_by_init<name>(name##_init)) return #name
  SAME(riis_points);
  SAME(riis_patches);
  SAME(riis_surface_options);
  SAME(riis_surface_arrays);
  SAME(riis_keyframe_arrays);
  SAME(riis_crossing_options);
  SAME(riis_closest_options);
  SAME(riis_closest_arrays);
  SAME(riis_csr);
  SAME(riis_mesh_cells);
  SAME(riis_mesh_faces);
  SAME(riis_resistance);
  SAME(riis_mark_options);
  SAME(riis_dense_arrays);
  SAME(riis_resistance_arrays);
  SAME(riis_flow_arrays);
  SAME(riis_band);
  SAME(riis_passage_ends);
  SAME(riis_opening_table);
  SAME(riis_opening_times);
  SAME(riis_opening_switch);
  SAME(riis_opening_switch_state);
  SAME(riis_opening_angle);
  SAME(riis_opening_angle_state);
  return "";
}

const char *cpp_wrong_with_spans() {
  double numbers[3] = {3, 1, 2};
  const riis::Span<double> all(numbers, 3);
  std::sort(all.begin(), all.end());
  if (numbers[0] != 1 || all[2] != 3 || all.size() != 3 || all.empty() || all.data() != numbers)
    return "a span is not its array";
  const riis::Span<const double> none(nullptr, 7);
  if (!none.empty() || none.begin() != none.end()) return "a span of an array that is not there has entries";
  return "";
}
