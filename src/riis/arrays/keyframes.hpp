// SPDX-License-Identifier: Apache-2.0
// The motion of a surface from frames at given times. The faces stay the same, and only the vertices move.
// In: frames, a time. Out: positions and velocities of the vertices at that time.
#pragma once

#include <riis/riis.h>

#include <vector>

#include "arrays/user_arrays.hpp"
#include "laws/key_times.hpp"

namespace riis {

class Keyframes {
 public:
  // Copies all arrays. Fails as triangles_from_arrays does with the faces and the first frame's vertices. A face without area is
  // not refused here, but only when a surface is made. Messages about bad coordinates name the frame.
  Keyframes(const riis_surface_arrays &arrays, const riis_keyframe_arrays &frames);
  Keyframes(Keyframes &&) = default;  // moving a vector leaves its elements, such as the times, at their address

  // Writes positions and velocities (3, n_vertices). With dt == 0 the velocity is the derivative of the interpolation. At a
  // linear key it is the derivative after the key. Otherwise the velocity is the mean from time - dt to time.
  void at(double time, double dt, std::vector<double> &xyz, std::vector<double> &velocity) const;

  const UserFaces &faces() const { return faces_; }

 private:
  std::vector<double> time_, xyz_;
  KeyTimes keys_;  // borrows time_, whose elements stay at their address when the vector is moved
  UserFaces faces_;
};

}  // namespace riis
