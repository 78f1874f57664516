// SPDX-License-Identifier: Apache-2.0
// Turns the caller's arrays of vertices and faces into triangles.
// This file checks the arrays of riis_surface_arrays completely. The triangles have the caller's ids.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "geometry/placement.hpp"
#include "laws/key_times.hpp"
#include "triangulate/triangle_set.hpp"

namespace riis {

// The caller's description of a skirt on the faces, and the edges at which the skirt begins.
struct UserSkirt {
  double length = 0;                   // before placement; 0: no skirt
  std::vector<std::uint8_t> attached;  // (n_vertices), or empty
  std::vector<double> lengths;         // (n_vertices), or empty
  std::vector<AttachedEdge> edges;     // pipeline/skirt_of_arrays.hpp finds them
  bool has_attachment() const { return length != 0 || !attached.empty(); }
};

// The caller's faces, checked and renumbered from 0.
struct UserFaces {
  std::int64_t n_vertices = 0, corners_per_face = 3;
  std::int64_t index_base = 0;           // the caller's base, for messages
  std::vector<std::int64_t> vertex_id;   // (corners_per_face, n_faces)
  std::vector<std::int32_t> leaflet_id;  // (n_faces)
  UserSkirt skirt;
};

// Copies the faces. `memory` is an object whose memory the function reuses. This function and triangles_from_arrays fail with
// RIIS_INVALID_ARGUMENT, RIIS_INVALID_SURFACE or RIIS_LIMIT_EXCEEDED. The message names the field, the face or vertex, and the
// value.
UserFaces faces_from_arrays(const riis_surface_arrays &arrays, UserFaces memory = {});

// Makes triangles from `faces` and from the vertices and velocities in `arrays`. Ignores the faces in `arrays`. `memory` is a set
// whose memory the function reuses.
TriangleSet triangles_from_arrays(const UserFaces &faces, const riis_surface_arrays &arrays, const Placement &placement,
                                  bool skip_zero_area, bool flip_normals, TriangleSet memory = {});

// The motion of a surface from frames at given times. The faces stay the same, and only the vertices move. The frames give the
// positions and velocities of the vertices at any time.

class Keyframes {
 public:
  // Copies all arrays. Checks the faces and the first frame's vertices, and fails as triangles_from_arrays does. A face without
  // area is refused only when a surface is made. Messages about bad coordinates name the frame.
  Keyframes(const riis_surface_arrays &arrays, const riis_keyframe_arrays &frames);
  Keyframes(Keyframes &&) = default;  // moving a vector keeps its elements, such as the times, in place

  // Writes positions and velocities (3, n_vertices). For dt == 0 the velocity is the derivative of the interpolation. Linear
  // interpolation has two derivatives at a key: before and after the key. The derivative after the key counts. For any other dt
  // the velocity is the mean velocity between the times `time - dt` and `time`.
  void at(double time, double dt, std::vector<double> &xyz, std::vector<double> &velocity) const;

  const UserFaces &faces() const { return faces_; }
  // The caller finds the edges of the skirt on these faces, with the vertices that first_frame returns.
  UserFaces &faces() { return faces_; }
  riis_surface_arrays first_frame() const;

 private:
  std::vector<double> time_, xyz_;
  KeyTimes keys_;  // borrows the elements of time_, which stay at their address when the vector is moved
  UserFaces faces_;
};

}  // namespace riis
