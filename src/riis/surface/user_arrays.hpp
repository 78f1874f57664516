// SPDX-License-Identifier: Apache-2.0
// Turns the caller's vertex and face arrays into triangles.
// In: arrays as in riis_surface_arrays, checked here in full. Out: triangles under the caller's ids.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "geometry/placement.hpp"
#include "surface/triangle_set.hpp"

namespace riis {

// The caller's faces, checked and counted from 0.
struct UserFaces {
  std::int64_t n_vertices = 0, corners_per_face = 3;
  std::int64_t index_base = 0;           // for messages
  std::vector<std::int64_t> vertex_id;   // (corners_per_face, n_faces)
  std::vector<std::int32_t> leaflet_id;  // (n_faces)
};

// Copies the faces into the memory of faces that are no longer wanted. Both functions fail with RIIS_INVALID_ARGUMENT,
// RIIS_INVALID_SURFACE or RIIS_LIMIT_EXCEEDED; the message names the field, the face or vertex, and the value.
UserFaces faces_from_arrays(const riis_surface_arrays &arrays, UserFaces memory = {});

// Makes triangles of faces and of the arrays' vertices and velocities, in the memory of triangles that are no longer wanted. The
// arrays' own faces do not count.
TriangleSet triangles_from_arrays(const UserFaces &faces, const riis_surface_arrays &arrays, const Placement &placement,
                                  bool skip_zero_area, bool flip_normals, TriangleSet memory = {});

}  // namespace riis
