// SPDX-License-Identifier: Apache-2.0
// The pipeline in one place: from a valve's parameters, or the caller's arrays, to a surface that answers closest points.
// In: a valve or arrays, where the surface stands, how exact it must be. Out: the surface, and the seconds that it took.
#pragma once

#include <riis/riis.h>

#include <cstdint>

#include "distance/surface.hpp"
#include "geometry/placement.hpp"
#include "valve/valve.hpp"

namespace riis {

// What every surface is made by. Lengths are in placed units, the mesh's.
struct SurfaceRequest {
  double half_thickness;
  Placement placement;
  bool flip_normals;
  int n_threads;
};

// How far distances to a generated valve may be from those to the smooth one, in placed units.
struct ValveAccuracy {
  double triangle_error;
  std::int32_t distance;  // RIIS_DISTANCE_*
  double distance_error;  // only for distances that triangles do not measure
};

struct SurfaceSeconds {
  double triangles, scene;
};

// Both replace the content of `surface` and reuse its memory; after a failure it is only fit to be made again.
// The first fails as the stages of the pipeline do, and with RIIS_INVALID_PARAMETER for a valve without area.
SurfaceSeconds make_surface(const Valve &valve, const SurfaceRequest &request, const ValveAccuracy &accuracy,
                            Surface &surface);
SurfaceSeconds make_surface(const riis_surface_arrays &arrays, bool skip_zero_area, const SurfaceRequest &request,
                            Surface &surface);

}  // namespace riis
