// SPDX-License-Identifier: Apache-2.0
// Interval arithmetic with first and second derivatives. It bounds a function and its derivatives on a range.
// In: ranges. Out: ranges that hold every value. Rounding of the bounds is ignored, because it is far smaller than the bounds.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/vec3.hpp"

namespace riis {

struct Interval {
  double low, high;

  static Interval of(double x) { return {x, x}; }
  double magnitude() const {
    const double larger = std::max(std::abs(low), std::abs(high));
    return low <= high ? larger : std::numeric_limits<double>::infinity();  // a NaN bound makes the comparison false
  }
};

inline Interval operator+(Interval a, Interval b) { return {a.low + b.low, a.high + b.high}; }
inline Interval operator-(Interval a, Interval b) { return {a.low - b.high, a.high - b.low}; }
// A bound of 0 times any bound is 0, even times infinity. The reason is that infinity stands for an arbitrarily large number,
// which is still finite.
inline double bound_product(double x, double y) { return x == 0 || y == 0 ? 0.0 : x * y; }
inline Interval operator*(Interval a, Interval b) {
  double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
  // A product may be infinite, or NaN if it is 0 times infinity. The sum shows this: it is finite only if all products are
  // finite.
  const double sum = (p + q) + (r + s);
  if (!(sum - sum == 0))
    p = bound_product(a.low, b.low), q = bound_product(a.low, b.high), r = bound_product(a.high, b.low),
    s = bound_product(a.high, b.high);
  return {std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s))};
}
inline Interval operator*(double a, Interval b) {
  double p = a * b.low, q = a * b.high;
  const double sum = p + q;
  if (!(sum - sum == 0)) p = bound_product(a, b.low), q = bound_product(a, b.high);
  return {std::min(p, q), std::max(p, q)};
}
inline Interval square(Interval a) {
  const double p = a.low * a.low, q = a.high * a.high;
  return {a.low <= 0 && a.high >= 0 ? 0.0 : std::min(p, q), std::max(p, q)};
}
// Takes the root of values that cannot be negative. A bound below 0 comes from overestimation and counts as 0.
inline Interval root(Interval a) { return {std::sqrt(std::max(a.low, 0.0)), std::sqrt(std::max(a.high, 0.0))}; }
// Inverts positive values. If their lower bound is not above 0, the upper bound of the result is infinite.
inline Interval inverse(Interval a) {
  return {1 / a.high, a.low > 0 ? 1 / a.low : std::numeric_limits<double>::infinity()};
}
inline Interval hull(Interval a, Interval b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }
inline Interval intersection(Interval a, Interval b) { return {std::max(a.low, b.low), std::min(a.high, b.high)}; }
inline Interval widened(Interval a, double by) { return {a.low - by, a.high + by}; }

// A function's value and its first two derivatives on a range.
struct Jet {
  Interval value, first, second;
};

inline Jet operator+(const Jet &a, const Jet &b) { return {a.value + b.value, a.first + b.first, a.second + b.second}; }
inline Jet operator-(const Jet &a, const Jet &b) { return {a.value - b.value, a.first - b.first, a.second - b.second}; }
inline Jet operator*(const Jet &a, const Jet &b) {
  return {a.value * b.value, a.first * b.value + a.value * b.first,
          a.second * b.value + 2 * (a.first * b.first) + a.value * b.second};
}
inline Jet operator*(double a, const Jet &b) { return {a * b.value, a * b.first, a * b.second}; }
inline Jet square(const Jet &a) {
  return {square(a.value), 2 * (a.value * a.first), 2 * (square(a.first) + a.value * a.second)};
}
// Takes the root of positive values.
inline Jet root(const Jet &a) {
  const Interval value = root(a.value), half_inverse = 0.5 * inverse(value), first = half_inverse * a.first;
  return {value, first, half_inverse * a.second - inverse(value) * square(first)};
}
inline Jet inverse(const Jet &a) {
  const Interval value = inverse(a.value), value_sq = square(value);
  return {value, -1 * (value_sq * a.first), 2 * (value * value_sq * square(a.first)) - value_sq * a.second};
}

struct IntervalVector {
  Interval x, y, z;

  static IntervalVector of(Vec3 p) { return {Interval::of(p.x), Interval::of(p.y), Interval::of(p.z)}; }
  Vec3 magnitudes() const { return {x.magnitude(), y.magnitude(), z.magnitude()}; }
};

inline IntervalVector operator-(const IntervalVector &a, const IntervalVector &b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline IntervalVector operator*(double a, const IntervalVector &b) { return {a * b.x, a * b.y, a * b.z}; }
inline IntervalVector hull(const IntervalVector &a, const IntervalVector &b) {
  return {hull(a.x, b.x), hull(a.y, b.y), hull(a.z, b.z)};
}

struct JetVector {
  Jet x, y, z;

  IntervalVector value() const { return {x.value, y.value, z.value}; }
  IntervalVector first() const { return {x.first, y.first, z.first}; }
  IntervalVector second() const { return {x.second, y.second, z.second}; }

  static JetVector of(const IntervalVector &value, const IntervalVector &first, const IntervalVector &second) {
    return {{value.x, first.x, second.x}, {value.y, first.y, second.y}, {value.z, first.z, second.z}};
  }
};

inline JetVector operator*(const Jet &a, const JetVector &b) { return {a * b.x, a * b.y, a * b.z}; }
inline Jet dot_self(const JetVector &a) { return square(a.x) + square(a.y) + square(a.z); }
inline JetVector cross(const JetVector &a, const JetVector &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace riis
