// SPDX-License-Identifier: Apache-2.0
// Turns the caller's vertex and face arrays into triangles.
// In: arrays as in riis_surface_arrays, checked here in full. Out: triangles under the caller's ids.
#pragma once

#include <riis/riis.h>

#include "geometry/placement.hpp"
#include "surface/triangle_set.hpp"

namespace riis {

// Makes triangles in the memory of triangles that are no longer wanted. Fails with RIIS_INVALID_ARGUMENT,
// RIIS_INVALID_SURFACE or RIIS_LIMIT_EXCEEDED; the message names the field, the face or vertex, and the value.
TriangleSet triangles_from_arrays(const riis_surface_arrays &arrays, const Placement &placement, bool skip_zero_area,
                                  bool flip_normals, TriangleSet memory = {});

}  // namespace riis
