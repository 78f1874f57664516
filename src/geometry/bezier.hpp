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

// kappa: the largest distance of an inner control point to the segment from the first to the last. (The paper measures
// to the line, which is 0/0 for a closed curve and blind to control points beyond the ends.)
double flatness(const Bezier &curve);

// Points on the curve from its first to its last, halved until every piece has flatness <= max_flatness (> 0): paper,
// algorithm "Recursive de Casteljau subdivision". The largest distance between a piece and its chord is then at most
// 3/4 max_flatness for cubic and 1/2 max_flatness for quadratic curves. A shared middle point appears once.
std::vector<Vec3> flatten(const Bezier &curve, double max_flatness);

}  // namespace riis
