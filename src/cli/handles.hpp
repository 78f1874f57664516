// SPDX-License-Identifier: Apache-2.0
// The library's handles, which destroy themselves.
#pragma once

#include <riis/riis.h>
#include <riis/riis_vtk.h>

#include <memory>

namespace riis::cli {

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
using MarkResult = Handle<riis_mark_result, riis_mark_result_destroy>;
using MeshFile = Handle<riis_vtk_mesh, riis_vtk_mesh_destroy>;
using Motion = Handle<riis_vtk_motion, riis_vtk_motion_destroy>;
using Keyframes = Handle<riis_keyframes, riis_keyframes_destroy>;
using Film = Handle<riis_vtk_film, riis_vtk_film_destroy>;
using SurfaceFile = Handle<riis_vtk_surface, riis_vtk_surface_destroy>;

}  // namespace riis::cli
