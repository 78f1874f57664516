// SPDX-License-Identifier: Apache-2.0
// The motion of a surface from frames at given times: the same faces, other places of the vertices.
// In: frames, a time. Out: places and velocities of the vertices at that time.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "laws/key_times.hpp"
#include "surface/user_arrays.hpp"

namespace riis {

class Keyframes {
 public:
  // Copies all arrays. Fails as triangles_from_arrays does for the faces in the first frame, except that faces without area are
  // left to the surfaces. A bad coordinate is named with its frame.
  Keyframes(const riis_surface_arrays &arrays, const riis_keyframe_arrays &frames);
  Keyframes(Keyframes &&) = default;  // the times stay in place

  // Writes places and velocities (3, n_vertices). With dt == 0 the velocity is the interpolant's derivative,
  // right-hand at a linear key; else it is the mean from time - dt to time.
  void at(double time, double dt, std::vector<double> &xyz, std::vector<double> &velocity) const;

  // Returns the ends of the steps from one time to a later one, ascending. The last is the later time. Within a step all vertices
  // move along nearly straight lines, exactly so for linear interpolation. Fails with RIIS_LIMIT_EXCEEDED for more than a million
  // keys.
  std::vector<double> steps_between(double time_from, double time_to) const;

  const UserFaces &faces() const { return faces_; }

 private:
  std::vector<double> time_, xyz_;
  KeyTimes keys_;  // checked once; it borrows the times, which stay in place when the vector moves
  UserFaces faces_;
};

}  // namespace riis
