// SPDX-License-Identifier: Apache-2.0
// Quadratic and cubic Bézier curves in space (paper, 3.2 "Curves").
// In: control points. Out: points, derivatives, lengths, halves, and points close enough together to replace the curve.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "geometry/vec3.hpp"

namespace riis {

struct Bezier {
  int degree;                   // 2 or 3
  std::array<Vec3, 4> control;  // the first degree + 1 are used

  static Bezier quadratic(Vec3 q0, Vec3 q1, Vec3 q2) { return {2, {q0, q1, q2, Vec3{0, 0, 0}}}; }
  static Bezier cubic(Vec3 q0, Vec3 q1, Vec3 q2, Vec3 q3) { return {3, {q0, q1, q2, q3}}; }
  // A curve that never leaves its point: the collapsed side of a patch.
  static Bezier point(Vec3 q) { return quadratic(q, q, q); }

  Vec3 first() const { return control[0]; }
  Vec3 last() const { return control[static_cast<std::size_t>(degree)]; }
};

// B(t) for t in [0,1]; the end points exactly at 0 and 1.
Vec3 evaluate(const Bezier &curve, double t);

// dB/dt.
Vec3 derivative(const Bezier &curve, double t);

// Length of the curve from parameter t0 to t1, t0 <= t1: adaptive Gauss-Legendre quadrature of |B'|, relative error
// about 1e-12.
double arc_length(const Bezier &curve, double t0 = 0.0, double t1 = 1.0);

// The two parts left and right of t, by de Casteljau's algorithm.
std::pair<Bezier, Bezier> split(const Bezier &curve, double t);

// The t in [0,1] at which the curve, of the given length > 0, has half of it behind it.
double halfway(const Bezier &curve, double curve_length);

// kappa: the largest distance of an inner control point to the segment from the first to the last. (The paper measures
// to the line, which is 0/0 for a closed curve and blind to control points beyond the ends.)
double flatness(const Bezier &curve);

// A bound on |P(t) - C(t)| for t in [0,1], where C is the curve and P its chord, both parametrised by the share of their own
// length: length^2 / 8 times the largest curvature, or the length itself where the curve may turn on the spot.
double chord_error(const Bezier &curve, double curve_length);

// A curve replaced by chords.
struct Flattened {
  std::vector<Vec3> points;    // on the curve, from its first to its last; the first alone where the length is 0
  std::vector<double> t;       // of every point: share of the curve's length, binary fractions from 0 to 1
  std::vector<double> errors;  // chord_error along every chord
  double length;               // of the curve
};

// Halves the curve until every piece has a flatness that keeps it within max_error (> 0) of its chord, and a chord error of at most
// max_error. A piece lies within 3/4 (cubic) or 1/2 (quadratic) of its flatness from its chord. Pieces are halved by length,
// where the paper (algorithm "Recursive de Casteljau subdivision") halves the parameter: shares of two curves then either
// agree to the last bit or differ by at least a piece, so patches have no slivers between them. A shared middle point
// appears once. Fails with RIIS_LIMIT_EXCEEDED for more than 2^20 pieces.
Flattened flatten(const Bezier &curve, double max_error);

}  // namespace riis
