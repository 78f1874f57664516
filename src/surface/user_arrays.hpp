// SPDX-License-Identifier: Apache-2.0
// The caller's vertex and face arrays to triangles.
// In: arrays as in riis_surface_arrays, checked here in full. Out: triangles under the caller's ids.
#pragma once

#include <riis/riis.h>

#include "geometry/placement.hpp"
#include "surface/triangle_set.hpp"

namespace riis {

// In the memory of triangles that are no longer wanted. Fails with RIIS_INVALID_ARGUMENT or RIIS_INVALID_SURFACE, naming the field, the
// face or vertex, and the value.
TriangleSet triangles_from_arrays(const riis_surface_arrays &arrays, const Placement &placement, bool skip_zero_area,
                                  bool flip_normals, TriangleSet memory = {});

}  // namespace riis
