// SPDX-License-Identifier: Apache-2.0
// Turns the caller's arrays of vertices and faces into triangles.
// In: arrays as in riis_surface_arrays, which this file checks completely. Out: triangles with the caller's ids.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "geometry/placement.hpp"
#include "triangulate/triangle_set.hpp"

namespace riis {

// The caller's faces, checked and renumbered from 0.
struct UserFaces {
  std::int64_t n_vertices = 0, corners_per_face = 3;
  std::int64_t index_base = 0;           // the caller's base, for messages
  std::vector<std::int64_t> vertex_id;   // (corners_per_face, n_faces)
  std::vector<std::int32_t> leaflet_id;  // (n_faces)
};

// Copies the faces. `memory` is an object whose memory is reused. Both functions fail with RIIS_INVALID_ARGUMENT,
// RIIS_INVALID_SURFACE or RIIS_LIMIT_EXCEEDED. The message names the field, the face or vertex, and the value.
UserFaces faces_from_arrays(const riis_surface_arrays &arrays, UserFaces memory = {});

// Makes triangles from `faces` and from the vertices and velocities in `arrays`. Ignores the faces in `arrays`. `memory` is a set
// whose memory is reused.
TriangleSet triangles_from_arrays(const UserFaces &faces, const riis_surface_arrays &arrays, const Placement &placement,
                                  bool skip_zero_area, bool flip_normals, TriangleSet memory = {});

}  // namespace riis
