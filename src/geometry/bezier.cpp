// SPDX-License-Identifier: Apache-2.0
#include "geometry/bezier.hpp"

#include <algorithm>

#include "api/errors.hpp"

namespace riis {
namespace {

std::size_t degree_of(const Bezier &curve) { return static_cast<std::size_t>(curve.degree); }

double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const double ab_sq = dot(ab, ab);
  const double t = ab_sq > 0 ? std::clamp(dot(p - a, ab) / ab_sq, 0.0, 1.0) : 0.0;
  return distance(p, a + t * ab);
}

// Gauss-Legendre rule with 8 points on [t0, t1].
double quadrature_of_speed(const Bezier &curve, double t0, double t1) {
  static constexpr double node[4] = {0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                     0.96028985649753623168};
  static constexpr double weight[4] = {0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                       0.10122853629037625915};
  const double middle = 0.5 * (t0 + t1), half = 0.5 * (t1 - t0);
  double sum = 0;
  for (int i = 0; i < 4; ++i)
    sum += weight[i] *
           (length(derivative(curve, middle - half * node[i])) + length(derivative(curve, middle + half * node[i])));
  return half * sum;
}

double adaptive_length(const Bezier &curve, double t0, double t1, double whole, double tolerance, int depth) {
  const double middle = 0.5 * (t0 + t1);
  const double left = quadrature_of_speed(curve, t0, middle), right = quadrature_of_speed(curve, middle, t1);
  if (depth == 0 || std::abs(left + right - whole) <= tolerance) return left + right;
  return adaptive_length(curve, t0, middle, left, 0.5 * tolerance, depth - 1) +
         adaptive_length(curve, middle, t1, right, 0.5 * tolerance, depth - 1);
}

// 2^20 pieces a curve: only reached by requests that no surface of this library could be made from.
constexpr int max_depth = 20;

void flatten_after_first(const Bezier &curve, double max_flatness, int depth, std::vector<Vec3> &points) {
  if (flatness(curve) <= max_flatness) {
    points.push_back(curve.last());
    return;
  }
  if (depth == max_depth)
    fail(RIIS_LIMIT_EXCEEDED, "a curve needs more than %d points for a flatness of %g: the tolerance is too small",
         1 << max_depth, max_flatness);
  const auto [left, right] = split(curve, 0.5);
  flatten_after_first(left, max_flatness, depth + 1, points);
  flatten_after_first(right, max_flatness, depth + 1, points);
}

}  // namespace

Vec3 evaluate(const Bezier &curve, double t) {
  if (t == 1.0) return curve.last();
  std::array<Vec3, 4> q = curve.control;
  for (std::size_t n = degree_of(curve); n > 0; --n)
    for (std::size_t i = 0; i < n; ++i) q[i] = mix(q[i], q[i + 1], t);
  return q[0];
}

Vec3 derivative(const Bezier &curve, double t) {
  std::array<Vec3, 4> q = curve.control;
  for (std::size_t n = degree_of(curve); n > 1; --n)
    for (std::size_t i = 0; i < n; ++i) q[i] = mix(q[i], q[i + 1], t);
  return static_cast<double>(curve.degree) * (q[1] - q[0]);
}

double arc_length(const Bezier &curve, double t0, double t1) {
  double control_length = 0;
  for (std::size_t i = 0; i < degree_of(curve); ++i) control_length += distance(curve.control[i], curve.control[i + 1]);
  // A cusp (|B'| = 0) inside converges linearly with depth: 40 halvings leave an error of about 1e-12 of the length.
  return adaptive_length(curve, t0, t1, quadrature_of_speed(curve, t0, t1), 1e-13 * control_length, 40);
}

std::pair<Bezier, Bezier> split(const Bezier &curve, double t) {
  const std::size_t n = degree_of(curve);
  Bezier left = curve, right = curve;
  std::array<Vec3, 4> q = curve.control;
  for (std::size_t level = 1; level <= n; ++level) {
    for (std::size_t i = 0; i + level <= n; ++i) q[i] = mix(q[i], q[i + 1], t);
    left.control[level] = q[0];
    right.control[n - level] = q[n - level];
  }
  return {left, right};
}

double flatness(const Bezier &curve) {
  double largest = 0;
  for (std::size_t i = 1; i < degree_of(curve); ++i)
    largest = std::max(largest, distance_to_segment(curve.control[i], curve.first(), curve.last()));
  return largest;
}

std::vector<Vec3> flatten(const Bezier &curve, double max_flatness) {
  std::vector<Vec3> points{curve.first()};
  flatten_after_first(curve, max_flatness, 0, points);
  return points;
}

}  // namespace riis
