// SPDX-License-Identifier: Apache-2.0
// The whole pipeline, from a valve's parameters or the caller's arrays to a surface that answers queries for closest points.
// In: a valve or arrays, the placement, the accuracy. Out: the surface, and the seconds that it took.
#pragma once

#include <riis/riis.h>

#include <cstdint>

#include "distance/surface.hpp"
#include "geometry/placement.hpp"
#include "pipeline/fixed_triangulation.hpp"
#include "surface/user_arrays.hpp"
#include "valve/valve.hpp"

namespace riis {

// Every surface is made with these values. Lengths are in placed units, the mesh's.
struct SurfaceRequest {
  double half_thickness;
  Placement placement;
  bool flip_normals;
  int n_threads;
};

// Limits for the difference between distances to a generated valve and to the smooth valve, in placed units.
struct ValveAccuracy {
  double triangle_error;
  std::int32_t measure;   // RIIS_MEASURE_*
  double distance_error;  // unused if triangles measure distances
  bool is_fixed;          // RIIS_TRIANGULATION_FIXED; if not, triangles are as large as the opening allows
};

// A valve's state before the present one. It gives the surface its velocity.
struct ValveMotion {
  const Valve &before;
  Placement placement_before;
  double seconds;  // from there to now, not 0
};

struct SurfaceSeconds {
  double triangles, scene;
};

// Both replace the content of `surface` and reuse its memory. After a failure the surface can only be made again.
// The first fails as the stages of the pipeline do. RIIS_INVALID_PARAMETER also refuses a valve without area and a motion
// between two valves of different builds. Without a motion the vertices have no velocity. The fixed triangulation is null
// unless accuracy.is_fixed.
SurfaceSeconds make_surface(const Valve &valve, const ValveMotion *moved, const SurfaceRequest &request,
                            const ValveAccuracy &accuracy, const FixedTriangulation *fixed, Surface &surface);
SurfaceSeconds make_surface(const UserFaces &faces, const riis_surface_arrays &arrays, bool skip_zero_area,
                            const SurfaceRequest &request, Surface &surface);

}  // namespace riis
