// SPDX-License-Identifier: Apache-2.0
// Polylines parametrised by their own length (paper, 3.2.2 "Polyline").
// In: points. Out: C(t), t in [0,1] the share of the length.
#pragma once

#include <vector>

#include "geometry/vec3.hpp"

namespace riis {

struct Polyline {
  std::vector<Vec3> points;  // at least 1
  std::vector<double> t;     // of every point, ascending from 0 to 1; all 0 where the length is 0
  double length;
};

// Repeated points are dropped, so that t ascends strictly. At least one point.
Polyline make_polyline(const std::vector<Vec3> &points);

// C(t) by linear interpolation, t in [0,1]; a vertex exactly at its own t. C(1) is the last point. (The paper's
// smallest t_i > t does not exist at t = 1.)
Vec3 evaluate(const Polyline &polyline, double t);

}  // namespace riis
