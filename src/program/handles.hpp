// SPDX-License-Identifier: Apache-2.0
// Adds handles of riis_vtk's objects to the handles of riis.hpp, and returns the content of handles as structs.
#pragma once

#include <riis/riis_vtk.h>
#include <riis/riis.hpp>

#include "program/refusal.hpp"

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

}  // namespace riis::program
