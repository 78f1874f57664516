// SPDX-License-Identifier: Apache-2.0
// The motion of a surface from frames at given times: the same faces, other places of the vertices.
// In: frames, a time. Out: places and velocities of the vertices at that time.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "laws/key_times.hpp"

namespace riis {

class Keyframes {
 public:
  // Copies all arrays. Fails as triangles_from_arrays does for the faces in the first frame, except that faces without area are
  // left to the surfaces. A bad coordinate is named with its frame.
  Keyframes(const riis_surface_arrays &faces, const riis_keyframe_arrays &frames);
  // The arrays that the faces point to move along; a copy would point to those of the original.
  Keyframes(Keyframes &&) = default;

  // Writes places and velocities (3, n_vertices). With since == time the velocity is the interpolant's derivative,
  // right-hand at a linear key; else it is the mean from `since` to `time`.
  void at(double time, double since, std::vector<double> &xyz, std::vector<double> &velocity) const;

  // Returns the faces with the other fields that the caller gave. Places and velocities are still to be set.
  const riis_surface_arrays &faces() const { return faces_; }

 private:
  std::vector<double> time_, xyz_;
  KeyTimes keys_;  // checked once; it borrows the times, which stay in place when the vector moves
  std::vector<std::int64_t> vertex_ids_;
  std::vector<std::int32_t> leaflet_id_;
  riis_surface_arrays faces_;
};

}  // namespace riis
