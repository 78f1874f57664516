// SPDX-License-Identifier: Apache-2.0
// Polylines parametrised by length (paper, 3.2.2 "Polyline").
// In: points or a curve. Out: C(t) for t in [0,1], the share of the length.
#pragma once

#include "base/recycled.hpp"
#include "geometry/curve.hpp"
#include "geometry/vec3.hpp"

namespace riis {

struct Polyline {
  Vector<Vec3> points;    // at least 1
  Vector<double> t;       // of every point, ascending from 0 to 1; a single 0 if the length is 0
  Vector<double> errors;  // of every segment: how far it may be, at equal t, from the curve that it stands for
  double length;          // length of that curve
};

// Returns the polyline through the points, parametrised by its own length and standing for itself. Drops repeated
// points, so that t ascends strictly. Needs at least one point.
Polyline make_polyline(const Vector<Vec3> &points);

// Returns the polyline that stands for a curve, with every segment within max_error (> 0) of it. Its t is the share of the
// curve's length, not of its own length as in the paper. So a vertex is where the curve is at that t, whatever the tolerance.
Polyline make_polyline(const Curve &curve, double max_error);
// Also keeps the velocity within max_bend of linear on each segment, as far as it is estimated.
Polyline make_polyline(const Curve &curve, double max_error, const Bezier &velocity, double max_bend);

// Returns the same polyline from its last point to its first.
Polyline reversed(const Polyline &polyline);

// Returns C(t) by linear interpolation, t in [0,1]. A vertex is exact at its own t, and C(1) is the last point. (The
// paper's smallest t_i > t does not exist at t = 1.)
Vec3 evaluate(const Polyline &polyline, double t);

}  // namespace riis
