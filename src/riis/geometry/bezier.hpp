// SPDX-License-Identifier: Apache-2.0
// Quadratic and cubic Bézier curves in space (paper, 3.2 "Curves").
// This file computes points, derivatives, lengths, parts and bounds of the curves.
#pragma once

#include <array>
#include <utility>

#include "base/recycled.hpp"
#include "common/array_view.hpp"
#include "geometry/vec3.hpp"

namespace riis {

struct Bezier {
  int degree;                   // 2 or 3
  std::array<Vec3, 4> control;  // only the first degree + 1 points are used

  static Bezier quadratic(Vec3 q0, Vec3 q1, Vec3 q2) { return {2, {q0, q1, q2, Vec3{0, 0, 0}}}; }
  static Bezier cubic(Vec3 q0, Vec3 q1, Vec3 q2, Vec3 q3) { return {3, {q0, q1, q2, q3}}; }
  static Bezier line(Vec3 q0, Vec3 q1) { return quadratic(q0, 0.5 * (q0 + q1), q1); }
  // Returns a curve that stays in one point. Such curves serve as collapsed sides of patches.
  static Bezier point(Vec3 q) { return quadratic(q, q, q); }

  Bezier reversed() const {
    return degree == 2 ? quadratic(control[2], control[1], control[0])
                       : cubic(control[3], control[2], control[1], control[0]);
  }

  // Returns whether the curve stays in one point.
  bool is_point() const {
    for (int i = 1; i <= degree; ++i)
      if (!(view(control)[i] == control[0])) return false;
    return true;
  }
  Vec3 first() const { return control[0]; }
  Vec3 last() const { return view(control)[degree]; }
};

// Returns B(t) for t in [0,1]. At t = 0 and t = 1 the result is exactly the end point.
Vec3 evaluate(const Bezier &curve, double t);

// Returns the first three derivatives by t.
std::array<Vec3, 3> derivatives(const Bezier &curve, double t);

// Returns dB/dt.
Vec3 derivative(const Bezier &curve, double t);

// Returns the length of the curve from parameter t0 to t1, t0 <= t1, by adaptive Gauss-Legendre quadrature of |B'|. The
// relative error is about 1e-12.
double arc_length(const Bezier &curve, double t0 = 0.0, double t1 = 1.0);

// Returns the two parts left and right of t, by de Casteljau's algorithm.
std::pair<Bezier, Bezier> split(const Bezier &curve, double t);

// Returns the t in [0,1] up to which the curve has the length `behind`, 0 <= behind <= curve_length. `curve_length` is the length
// of the whole curve. For a curve of length 0, t is 0.
double parameter_at_length(const Bezier &curve, double curve_length, double behind);

// Writes to t the results of parameter_at_length for ascending lengths `behind`. One pass over the curve takes a fraction of the
// time of separate calls.
void parameters_at_lengths(const Bezier &curve, double curve_length, const Vector<double> &behind, double *t);

// Divides the curve between two parameters into eight parts of equal length. Writes the seven parameters between these parts to
// t. `length` is the length between the two given parameters. Returns false if one pass does not find the parameters.
bool divide_part(const Bezier &curve, double curve_length, double from, double to, double length,
                 std::array<double, 7> &t);

// Returns kappa, the largest distance of an inner control point from the segment between the first and the last control point.
// The paper uses the distance from the line through both points. The paper's distance is 0/0 for a closed curve, and misses
// control points beyond the ends.
double flatness(const Bezier &curve);

// Bounds the curvature everywhere on the curve. The bound is infinite if the derivative may be 0 somewhere.
double largest_curvature(const Bezier &curve);
// Bounds the curvature from parameter t0 to t1, t0 < t1. Compared with largest_curvature, this bound is looser and takes a tenth
// of the time.
double rough_curvature(const Bezier &curve, double t0, double t1);

}  // namespace riis
