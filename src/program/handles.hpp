// SPDX-License-Identifier: Apache-2.0
// Handles whose destructors destroy the library's objects.
#pragma once

#include <riis/riis.h>
#include <riis/riis_vtk.h>

#include <memory>

#include "program/refusal.hpp"

namespace riis::program {

template <class T, void (*destroy)(T **)>
struct Destroy {
  void operator()(T *handle) const { destroy(&handle); }
};
template <class T, void (*destroy)(T **)>
using Handle = std::unique_ptr<T, Destroy<T, destroy>>;

using Valve = Handle<riis_valve, riis_valve_destroy>;
using Surface = Handle<riis_surface, riis_surface_destroy>;
using Mesh = Handle<riis_mesh, riis_mesh_destroy>;
using Adjacency = Handle<riis_adjacency, riis_adjacency_destroy>;
using Marks = Handle<riis_marks, riis_marks_destroy>;
using Leaks = Handle<riis_leaks, riis_leaks_destroy>;
using Crossings = Handle<riis_crossings, riis_crossings_destroy>;
using MeshFile = Handle<riis_vtk_mesh, riis_vtk_mesh_destroy>;
using Motion = Handle<riis_vtk_motion, riis_vtk_motion_destroy>;
using Keyframes = Handle<riis_keyframes, riis_keyframes_destroy>;
using Film = Handle<riis_vtk_film, riis_vtk_film_destroy>;
using SurfaceFile = Handle<riis_vtk_surface, riis_vtk_surface_destroy>;

// These functions return the content of handles as structs.
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
