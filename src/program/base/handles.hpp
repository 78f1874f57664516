// SPDX-License-Identifier: Apache-2.0
// Adds handles of riis_vtk's objects to the handles of riis.hpp. Returns the content of handles, and arrays of triangles, as
// structs.
#pragma once

#include <riis/riis_vtk.h>
#include <riis/riis.hpp>

#include <cstdint>
#include <vector>

#include "common/array_view.hpp"
#include "program/base/refusal.hpp"

namespace riis::program {

using MeshFile = Handle<riis_vtk_mesh, riis_vtk_mesh_destroy>;
using Motion = Handle<riis_vtk_motion, riis_vtk_motion_destroy>;
using Film = Handle<riis_vtk_film, riis_vtk_film_destroy>;
using SurfaceFile = Handle<riis_vtk_surface, riis_vtk_surface_destroy>;

// The functions below return the content of handles as structs.
inline riis_triangles triangles_of(const riis_surface *surface) {
  riis_triangles triangles{};
  check(riis_surface_get_triangles(surface, &triangles, sizeof triangles));
  return triangles;
}
inline riis_surface_info info_of(const riis_surface *surface) {
  riis_surface_info info{};
  check(riis_surface_get_info(surface, &info, sizeof info));
  return info;
}
inline riis_mark_list list_of(const riis_marks *marks, int32_t which) {
  riis_mark_list list{};
  check(riis_marks_get_list(marks, which, &list, sizeof list));
  return list;
}
inline riis_leak_list list_of(const riis_leaks *leaks) {
  riis_leak_list list{};
  check(riis_leaks_get_list(leaks, &list, sizeof list));
  return list;
}

// Returns arrays that borrow vertices (3, n) and the corners (3, n) of triangles.
inline riis_surface_arrays arrays_of(const std::vector<double> &xyz, const std::vector<int64_t> &corners) {
  riis_surface_arrays arrays;
  check(riis_surface_arrays_init(&arrays, sizeof arrays));
  arrays.n_vertices = view(xyz).size() / 3;
  arrays.x = xyz.data();
  arrays.y = xyz.data() + 1;
  arrays.z = xyz.data() + 2;
  arrays.stride = 3;
  arrays.n_faces = view(corners).size() / 3;
  arrays.vertex_ids = corners.data();
  arrays.id_bits = 64;
  return arrays;
}

}  // namespace riis::program
