// SPDX-License-Identifier: Apache-2.0
#include "geometry/bezier.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

#include <algorithm>
#include <cmath>
#include <limits>

namespace riis {
namespace {

std::size_t degree_of(const Bezier &curve) { return static_cast<std::size_t>(curve.degree); }

double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const double ab_sq = dot(ab, ab);
  const double t = ab_sq > 0 ? std::clamp(dot(p - a, ab) / ab_sq, 0.0, 1.0) : 0.0;
  return distance(p, a + t * ab);
}

// Two numbers in one register. Every processor that the library supports has registers of this width.
typedef double Two __attribute__((vector_size(16)));

Two root(Two a) {
#if defined(__SSE2__)
  return _mm_sqrt_pd(a);
#elif defined(__aarch64__)
  return (Two)vsqrtq_f64((float64x2_t)a);
#else
  return Two{std::sqrt(a[0]), std::sqrt(a[1])};
#endif
}

// Computes |B'(t)| from the coefficients of B' in powers of t. The innermost loop of every computation of a length evaluates this
// speed.
struct Speed {
  explicit Speed(const Bezier &curve) {
    const auto &q = curve.control;
    const double n = curve.degree;
    constant = n * (q[1] - q[0]);
    linear = (n * (n - 1)) * ((q[2] - q[1]) - (q[1] - q[0]));
    quadratic = curve.degree == 3 ? 3.0 * ((q[3] - q[0]) - 3.0 * (q[2] - q[1])) : Vec3{0, 0, 0};
  }
  double operator()(double t) const { return length(constant + t * (linear + t * quadratic)); }
  // Computes |B'(t)| for two parameters at once, with the same bits as for one parameter at a time.
  Two operator()(Two t) const {
    const Two x = constant.x + t * (linear.x + t * quadratic.x), y = constant.y + t * (linear.y + t * quadratic.y),
              z = constant.z + t * (linear.z + t * quadratic.z);
    return root(x * x + y * y + z * z);
  }

  Vec3 constant, linear, quadratic;
};

// Integrates the speed over [t0, t1] by the Gauss-Legendre rule with 8 points.
double quadrature(const Speed &speed, double t0, double t1) {
  static constexpr double node[4] = {0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                     0.96028985649753623168};
  static constexpr double weight[4] = {0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                       0.10122853629037625915};
  const double middle = 0.5 * (t0 + t1), half = 0.5 * (t1 - t0);
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    const Two at_both = speed(middle + half * Two{-node[i], node[i]});
    sum += weight[i] * (at_both[0] + at_both[1]);
  }
  return half * sum;
}

double adaptive_length(const Speed &speed, double t0, double t1, double whole, double tolerance, int depth) {
  const double middle = 0.5 * (t0 + t1);
  const double left = quadrature(speed, t0, middle), right = quadrature(speed, middle, t1);
  // The condition is negated, so that a NaN also ends the recursion.
  if (depth == 0 || !(std::abs(left + right - whole) > tolerance)) return left + right;
  return adaptive_length(speed, t0, middle, left, 0.5 * tolerance, depth - 1) +
         adaptive_length(speed, middle, t1, right, 0.5 * tolerance, depth - 1);
}

// Returns the error that is allowed in the length of this curve.
double length_tolerance(const Bezier &curve) {
  double control_length = 0, largest = 0;
  for (std::size_t i = 0; i <= degree_of(curve); ++i) {
    const Vec3 q = curve.control[i];
    if (i > 0) control_length += distance(curve.control[i - 1], q);
    largest = std::max({largest, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
  }
  // The second term of the tolerance covers rounding, which matters if a curve is short but has large coordinates. The third term
  // is for a curve so short that the squares of its coordinates underflow. Such a curve is shorter than any triangle's edge
  // (triangulate/triangle_set.hpp).
  return 1e-13 * control_length + 1e-14 * largest + 1e-74;
}

double length_between(const Speed &speed, double tolerance, double t0, double t1) {
  // A part is halved at most 40 times. At a cusp (|B'| = 0) each halving only halves the error, so an error of about 1e-12 of the
  // length remains.
  return adaptive_length(speed, t0, t1, quadrature(speed, t0, t1), tolerance, 40);
}

// Guesses the parameter at which the curve has reached a given share of its length. Approximates the speed by the parabola
// through its values at 0, 1/2 and 1.
double first_guess(const Speed &speed, double share) {
  const double start = speed(0), middle = speed(0.5), end = speed(1);
  const double slope = 4 * middle - 3 * start - end, bend = 2 * (start - 2 * middle + end);
  const auto length_to = [&](double t) { return t * (start + t * (slope / 2 + t * (bend / 3))); };
  const double target = share * length_to(1);
  double t = share;
  for (int i = 0; i < 3; ++i) {
    const double next = t - (length_to(t) - target) / (start + t * (slope + t * bend));
    if (!(next > 0 && next < 1)) return share;
    t = next;
  }
  return t;
}

// Integrates the speed over a range of t shorter than 1/1000. In a range this short, the rule with 2 points is exact up to
// rounding.
double short_quadrature(const Speed &speed, double t0, double t1) {
  constexpr double node = 0.57735026918962576451;
  const double middle = 0.5 * (t0 + t1), half = 0.5 * (t1 - t0);
  return half * (speed(middle - half * node) + speed(middle + half * node));
}

// Integrates the speed in steps that are at most 1/12 long in t. In steps this short, the rule with 8 points is exact up to
// rounding if the speed is nowhere nearly 0.
double stepwise_quadrature(const Speed &speed, double t0, double t1) {
  constexpr double longest = 1.0 / 12;
  if (t1 - t0 <= longest) return quadrature(speed, t0, t1);
  const int n = static_cast<int>(std::ceil((t1 - t0) / longest));
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += quadrature(speed, t0 + (t1 - t0) * i / n, t0 + (t1 - t0) * (i + 1) / n);
  return sum;
}

// A part of a curve, from one parameter to another. The allowed error of a length is a share of the whole curve's length.
struct SpeedOnPart {
  Speed speed;
  double from, to, length, whole_length;
};

// Finds the parameters at which the curve has given lengths from the start of the part. The lengths ascend. Each parameter is
// found from the previous parameter. Returns false if the lengths do not add up to the length of the part. Each step is one
// quadrature, which is inaccurate where the speed is far from a polynomial, as at a cusp.
bool find_in_one_pass(const SpeedOnPart &part, const double *behind, std::size_t n, double *t) {
  const Speed &speed = part.speed;
  const double close_enough = 1e-14 * part.whole_length;
  double at = part.from, at_length = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double wanted = behind[k] - at_length, start = speed(at);
    const double straight = std::min(at + wanted / start, part.to);
    double next = std::min(at + 2 * wanted / (start + speed(straight)), part.to);
    if (!(next >= at)) return false;
    double made = stepwise_quadrature(speed, at, next);
    for (int i = 0; i < 6 && std::abs(made - wanted) > close_enough; ++i) {
      const double closer = std::clamp(next - (made - wanted) / speed(next), at, part.to);
      made += std::abs(closer - next) < 1e-3 ? short_quadrature(speed, next, closer)
                                             : stepwise_quadrature(speed, next, closer);
      next = closer;
    }
    // Near a cusp, Newton's method may not have converged yet, and the fast method gives up.
    if (!(std::abs(made - wanted) <= 1e-13 * part.whole_length)) return false;
    at = t[k] = next;
    at_length += made;
  }
  const double excess = at_length + stepwise_quadrature(speed, at, part.to) - part.length;
  return std::abs(excess) <= 1e-12 * part.whole_length;
}

}  // namespace

Vec3 evaluate(const Bezier &curve, double t) {
  if (t == 1.0) return curve.last();
  std::array<Vec3, 4> q = curve.control;
  for (std::size_t n = degree_of(curve); n > 0; --n)
    for (std::size_t i = 0; i < n; ++i) q[i] = mix(q[i], q[i + 1], t);
  return q[0];
}

std::array<Vec3, 3> derivatives(const Bezier &curve, double t) {
  const auto &q = curve.control;
  const double s = 1 - t;
  if (curve.degree == 2) {
    const Vec3 a = 2 * (q[1] - q[0]), b = 2 * (q[2] - q[1]);
    return {s * a + t * b, b - a, Vec3{0, 0, 0}};
  }
  const Vec3 a = 3 * (q[1] - q[0]), b = 3 * (q[2] - q[1]), c = 3 * (q[3] - q[2]);
  const Vec3 d = 2 * (b - a), e = 2 * (c - b);
  return {s * s * a + 2 * s * t * b + t * t * c, s * d + t * e, e - d};
}

Vec3 derivative(const Bezier &curve, double t) {
  std::array<Vec3, 4> q = curve.control;
  for (std::size_t n = degree_of(curve); n > 1; --n)
    for (std::size_t i = 0; i < n; ++i) q[i] = mix(q[i], q[i + 1], t);
  return curve.degree * (q[1] - q[0]);
}

double arc_length(const Bezier &curve, double t0, double t1) {
  return length_between(Speed(curve), length_tolerance(curve), t0, t1);
}

// Each point is a separate variable. If the points were an array, the compiler would store them in memory, and load them again at
// once.
std::pair<Bezier, Bezier> split(const Bezier &curve, double t) {
  const auto &q = curve.control;
  const Vec3 a = mix(q[0], q[1], t), b = mix(q[1], q[2], t), ab = mix(a, b, t);
  if (curve.degree == 2) return {Bezier::quadratic(q[0], a, ab), Bezier::quadratic(ab, b, q[2])};
  const Vec3 c = mix(q[2], q[3], t), bc = mix(b, c, t), abc = mix(ab, bc, t);
  return {Bezier::cubic(q[0], a, ab, abc), Bezier::cubic(abc, bc, c, q[3])};
}

double flatness(const Bezier &curve) {
  double largest = 0;
  for (std::size_t i = 1; i < degree_of(curve); ++i)
    largest = std::max(largest, distance_to_segment(curve.control[i], curve.first(), curve.last()));
  return largest;
}

// Bounds the curvature |B' x B''| / |B'|^3. The bound is infinite if the derivative may be 0 somewhere. B' and B'' are Bézier
// curves with the control points `first` and `second`. Products of these control points bound the numerator. Along the chord, B'
// is at least as long as the shortest of its control points, which bounds the denominator from below.
template <std::size_t n, std::size_t m>
static double rough_curvature(const Vec3 (&first)[n], const Vec3 (&second)[m], Vec3 chord) {
  double least_along = std::numeric_limits<double>::infinity(), largest_sq = 0;
  for (const Vec3 &a : first) least_along = std::min(least_along, dot(a, chord));
  if (!(least_along > 0)) return std::numeric_limits<double>::infinity();
  for (const Vec3 &b : second)
    for (const Vec3 &a : first) {
      const Vec3 product = cross(a, b);
      largest_sq = std::max(largest_sq, dot(product, product));
    }
  const double least_speed = least_along / length(chord);
  return std::sqrt(largest_sq) / (least_speed * least_speed * least_speed);
}

// The control points of the derivatives are differences of the curve's control points.
static double rough_curvature(const Bezier &curve) {
  const auto &q = curve.control;
  const Vec3 chord = curve.last() - curve.first();
  if (curve.degree == 2) {
    const Vec3 first[2] = {2.0 * (q[1] - q[0]), 2.0 * (q[2] - q[1])}, second[1] = {first[1] - first[0]};
    return rough_curvature(first, second, chord);
  }
  const Vec3 first[3] = {3.0 * (q[1] - q[0]), 3.0 * (q[2] - q[1]), 3.0 * (q[3] - q[2])};
  const Vec3 second[2] = {2.0 * (first[1] - first[0]), 2.0 * (first[2] - first[1])};
  return rough_curvature(first, second, chord);
}

double rough_curvature(const Bezier &curve, double t0, double t1) {
  // The blossoms of B' and B'' give the control points of the derivatives on this part of the curve. The part's chord is parallel
  // to the sum of the three vectors in `first`.
  const Speed along(curve);
  const Vec3 first[3] = {along.constant + t0 * (along.linear + t0 * along.quadratic),
                         along.constant + (0.5 * (t0 + t1)) * along.linear + (t0 * t1) * along.quadratic,
                         along.constant + t1 * (along.linear + t1 * along.quadratic)};
  const Vec3 second[2] = {along.linear + (2 * t0) * along.quadratic, along.linear + (2 * t1) * along.quadratic};
  return rough_curvature(first, second, first[0] + first[1] + first[2]);
}

double largest_curvature(const Bezier &curve) {
  // Bounds each quarter of the curve separately. The bound from control points is tighter for a quarter, because the control
  // points of a quarter vary less.
  const auto [left, right] = split(curve, 0.5);
  const auto [first, second] = split(left, 0.5);
  const auto [third, fourth] = split(right, 0.5);
  return std::max({rough_curvature(first), rough_curvature(second), rough_curvature(third), rough_curvature(fourth)});
}

double parameter_at_length(const Bezier &curve, double curve_length, double behind) {
  if (!(curve_length > 0)) return 0;
  const Speed speed(curve);
  const double tolerance = length_tolerance(curve), close_enough = 1e-14 * curve_length;
  // Newton's method finds the t at which the length from 0 to t is `behind`. The interval from `below` to `above` always contains
  // this t, and shrinks in each step.
  double below = 0, above = 1, t = first_guess(speed, behind / curve_length);
  double excess = length_between(speed, tolerance, 0, t) - behind;
  for (int i = 0; i < 60 && !(std::abs(excess) <= close_enough); ++i) {
    (excess > 0 ? above : below) = t;
    double next = t - excess / speed(t);
    if (!(next > below && next < above)) next = 0.5 * (below + above);
    excess += next > t ? length_between(speed, tolerance, t, next) : -length_between(speed, tolerance, next, t);
    t = next;
  }
  return t;
}

void parameters_at_lengths(const Bezier &curve, double curve_length, const Vector<double> &behind, double *t) {
  if (curve_length > 0 &&
      find_in_one_pass({Speed(curve), 0, 1, curve_length, curve_length}, behind.data(), behind.size(), t))
    return;
  for (std::size_t k = 0; k < behind.size(); ++k) t[k] = parameter_at_length(curve, curve_length, behind[k]);
}

bool divide_part(const Bezier &curve, double curve_length, double from, double to, double length,
                 std::array<double, 7> &t) {
  std::array<double, 7> behind;
  for (std::size_t k = 0; k < 7; ++k) view(behind)[k] = 0.125 * static_cast<double>(k + 1) * length;
  return curve_length > 0 &&
         find_in_one_pass({Speed(curve), from, to, length, curve_length}, behind.data(), behind.size(), t.data());
}

}  // namespace riis
