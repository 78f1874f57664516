// SPDX-License-Identifier: Apache-2.0
// Polylines parametrised by length (paper, 3.2.2 "Polyline").
// In: points or a curve. Out: C(t) for t in [0,1], where t is the share of the length.
#pragma once

#include "base/recycled.hpp"
#include "geometry/curve.hpp"
#include "geometry/vec3.hpp"

namespace riis {

struct Polyline {
  Vector<Vec3> points;    // at least 1
  Vector<double> t;       // t of every point, ascending from 0 to 1; a single 0 if the length is 0
  Vector<double> errors;  // for every segment, a bound on its distance at equal t from the curve that it replaces
  double length;          // the length of that curve
};

// Returns the polyline through the points, parametrised by its own length. It replaces no curve, so its errors are 0. Drops
// repeated points, so that t ascends strictly. Needs at least one point.
Polyline make_polyline(const Vector<Vec3> &points);

// Returns a polyline that replaces a curve. Every segment is within max_error (> 0) of the curve. A vertex's t is its share of
// the curve's length, not of the polyline's length as in the paper. So the vertex is the curve's point at that t for any
// tolerance.
Polyline make_polyline(const Curve &curve, double max_error);
// Makes the polyline of a curve that moves. It also keeps the estimated distance of the velocity from linear within max_bend on
// each segment.
Polyline make_polyline(const Curve &curve, double max_error, const Bezier &velocity, double max_bend);

// Returns the same polyline in the opposite direction.
Polyline reversed(const Polyline &polyline);

// Returns C(t) by linear interpolation, t in [0,1]. At the t of a vertex the result is exactly the vertex, and C(1) is the last
// point. (The paper uses the smallest t_i > t, which does not exist at t = 1.)
Vec3 evaluate(const Polyline &polyline, double t);

}  // namespace riis
