// SPDX-License-Identifier: Apache-2.0
// The library's handles with their destruction, for benchmarks: an error ends the program.
#pragma once

#include <riis/riis.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

namespace bench {

inline void check(riis_status status) {
  if (status == RIIS_OK) return;
  std::fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error());
  std::exit(1);
}

template <class Handle, void (*destroy)(Handle **)>
struct Destroy {
  void operator()(Handle *handle) const { destroy(&handle); }
};
using Valve = std::unique_ptr<riis_valve, Destroy<riis_valve, riis_valve_destroy>>;
using Surface = std::unique_ptr<riis_surface, Destroy<riis_surface, riis_surface_destroy>>;
using Mesh = std::unique_ptr<riis_mesh, Destroy<riis_mesh, riis_mesh_destroy>>;
using Adjacency = std::unique_ptr<riis_adjacency, Destroy<riis_adjacency, riis_adjacency_destroy>>;
using Result = std::unique_ptr<riis_marks, Destroy<riis_marks, riis_marks_destroy>>;

inline Valve make_valve(const char *kind) {
  riis_valve *valve = nullptr;
  check(riis_valve_create(kind, &valve));
  return Valve(valve);
}

// NULL options are the defaults.
inline Surface make_surface(const riis_valve *valve, const riis_surface_options *options = nullptr) {
  riis_surface *surface = nullptr;
  check(riis_surface_create(valve, options, &surface));
  return Surface(surface);
}

inline Surface make_surface(const riis_surface_arrays &arrays, double half_thickness) {
  riis_surface_options options;
  check(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = half_thickness;
  riis_surface *surface = nullptr;
  check(riis_surface_create_from_arrays(&arrays, &options, &surface));
  return Surface(surface);
}

inline Result make_result() {
  riis_marks *result = nullptr;
  check(riis_marks_create(&result));
  return Result(result);
}

inline riis_mark_stats stats_of(const riis_marks *result) {
  riis_mark_stats stats;
  check(riis_marks_get_stats(result, &stats, sizeof stats));
  return stats;
}

inline double n_triangles_of(const riis_surface *surface) {
  riis_surface_info info;
  check(riis_surface_get_info(surface, &info, sizeof info));
  return static_cast<double>(info.n_triangles);
}

}  // namespace bench
