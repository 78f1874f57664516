// SPDX-License-Identifier: Apache-2.0
#include "program/joined_surface.hpp"

#include <algorithm>

#include "common/array_view.hpp"
#include "program/refusal.hpp"

namespace riis::program {

int32_t n_leaflets_of(const riis_surface *surface) {
  const riis_triangles triangles = triangles_of(surface);
  const int32_t *const end = triangles.leaflet_id + triangles.n_triangles;
  return triangles.n_triangles > 0 ? *std::max_element(triangles.leaflet_id, end) + 1 : 0;
}

std::vector<int32_t> first_leaflets(const std::vector<MovingValve> &valves) {
  std::vector<int32_t> first = {0};
  for (const MovingValve &valve : valves) first.push_back(first.back() + n_leaflets_of(valve.surface()));
  return first;
}

Surface joined_surface(const std::vector<MovingValve> &valves, const riis_surface_options *options) {
  std::vector<double> xyz;
  std::vector<int64_t> corners;
  std::vector<int32_t> leaflets;
  const std::vector<int32_t> first = first_leaflets(valves);
  for (std::size_t valve = 0; valve < valves.size(); ++valve) {
    const riis_triangles triangles = triangles_of(valves[valve].surface());
    const int64_t before = view(xyz).size() / 3;
    xyz.insert(xyz.end(), triangles.xyz, triangles.xyz + 3 * triangles.n_vertices);
    for (int64_t i = 0; i < 3 * triangles.n_triangles; ++i) corners.push_back(before + triangles.vertex_id[i]);
    for (int64_t i = 0; i < triangles.n_triangles; ++i) leaflets.push_back(first[valve] + triangles.leaflet_id[i]);
  }
  riis_surface_arrays arrays;
  check(riis_surface_arrays_init(&arrays, sizeof arrays));
  arrays.n_vertices = view(xyz).size() / 3;
  arrays.x = xyz.data();
  arrays.y = xyz.data() + 1;
  arrays.z = xyz.data() + 2;
  arrays.stride = 3;
  arrays.n_faces = view(leaflets).size();
  arrays.vertex_ids = corners.data();
  arrays.id_bits = 64;
  arrays.leaflet_id = leaflets.data();
  riis_surface *surface = nullptr;
  check(riis_surface_create_from_arrays(&arrays, options, &surface));
  return Surface(surface);
}

}  // namespace riis::program
