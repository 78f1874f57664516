// SPDX-License-Identifier: Apache-2.0
// Gives destructors to the library's handles, for benchmarks. An error ends the program.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

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
using Leaks = std::unique_ptr<riis_leaks, Destroy<riis_leaks, riis_leaks_destroy>>;
using Crossings = std::unique_ptr<riis_crossings, Destroy<riis_crossings, riis_crossings_destroy>>;
using Result = std::unique_ptr<riis_marks, Destroy<riis_marks, riis_marks_destroy>>;

inline Valve make_valve(const char *kind) {
  riis_valve *valve = nullptr;
  check(riis_valve_create(kind, &valve));
  return Valve(valve);
}

// If options is NULL, the defaults are used.
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

inline Leaks make_leaks() {
  riis_leaks *leaks = nullptr;
  check(riis_leaks_create(&leaks));
  return Leaks(leaks);
}

inline Crossings make_crossings() {
  riis_crossings *crossings = nullptr;
  check(riis_crossings_create(&crossings));
  return Crossings(crossings);
}

inline riis_mark_stats stats_of(const riis_marks *result) {
  riis_mark_stats stats;
  check(riis_marks_get_stats(result, &stats, sizeof stats));
  return stats;
}

inline riis_mark_list marked_in(const riis_marks *marks) {
  riis_mark_list list;
  check(riis_marks_get_list(marks, RIIS_LIST_MARKED, &list, sizeof list));
  return list;
}

inline riis_triangles triangles_of(const riis_surface *surface) {
  riis_triangles triangles;
  check(riis_surface_get_triangles(surface, &triangles, sizeof triangles));
  return triangles;
}

// Describes points xyz (3, n).
inline riis_points points_of(std::int64_t n, const double *xyz) {
  riis_points points;
  check(riis_points_init(&points, sizeof points));
  points.n_points = n;
  points.x = xyz, points.y = xyz + 1, points.z = xyz + 2;
  points.stride = 3;
  return points;
}

// Writes the distances of marked nodes. Other nodes get far_distance.
inline void get_distances(const riis_marks *marks, double far_distance, std::vector<double> &distance) {
  riis_dense_arrays arrays;
  check(riis_dense_arrays_init(&arrays, sizeof arrays));
  arrays.n_nodes = static_cast<std::int64_t>(distance.size());
  arrays.far_distance = far_distance;
  arrays.distance = distance.data();
  check(riis_marks_get_dense(marks, &arrays));
}

// Adds the resistance K to the array K (n), and K u_surface to the array K_u_surface (3, n). K_u_surface may be NULL.
inline void add_resistance(const riis_marks *marks, const riis_resistance &resistance, std::vector<double> &K,
                           double *K_u_surface) {
  riis_resistance_arrays arrays;
  check(riis_resistance_arrays_init(&arrays, sizeof arrays));
  arrays.n_nodes = static_cast<std::int64_t>(K.size());
  arrays.K = K.data();
  for (int c = 0; K_u_surface && c < 3; ++c) arrays.K_u_surface[c] = K_u_surface + c;
  arrays.K_u_surface_stride = 3;
  check(riis_marks_add_resistance(marks, &resistance, &arrays));
}

inline double n_triangles_of(const riis_surface *surface) {
  riis_surface_info info;
  check(riis_surface_get_info(surface, &info, sizeof info));
  return static_cast<double>(info.n_triangles);
}

}  // namespace bench
