// SPDX-License-Identifier: Apache-2.0
// Ball arithmetic: bounds a vector or a number on a range by a middle value and the largest distance from it.
// In: ranges. Out: ranges that hold every value. Rounding of the bounds is ignored, because it is far smaller than the bounds.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/vec3.hpp"

namespace riis {

// All numbers within `radius` of `middle`.
struct Interval {
  double middle, radius;

  static Interval between(double low, double high) { return {0.5 * (low + high), 0.5 * (high - low)}; }
  double magnitude() const { return std::abs(middle) + radius; }
};

inline Interval operator+(Interval a, Interval b) { return {a.middle + b.middle, a.radius + b.radius}; }
inline Interval operator-(Interval a, Interval b) { return {a.middle - b.middle, a.radius + b.radius}; }
inline Interval operator*(double a, Interval b) { return {a * b.middle, std::abs(a) * b.radius}; }
inline Interval operator*(Interval a, Interval b) {
  return {a.middle * b.middle, std::abs(a.middle) * b.radius + a.radius * b.magnitude()};
}

// All vectors within `radius` of `middle`.
struct Ball {
  Vec3 middle;
  double radius;

  double least_length() const { return length(middle) - radius; }
  double largest_length() const { return length(middle) + radius; }
};

inline Ball operator+(const Ball &a, const Ball &b) { return {a.middle + b.middle, a.radius + b.radius}; }
inline Ball operator-(const Ball &a, const Ball &b) { return {a.middle - b.middle, a.radius + b.radius}; }
inline Ball operator*(double a, const Ball &b) { return {a * b.middle, std::abs(a) * b.radius}; }
inline Ball operator*(Interval a, const Ball &b) {
  return {a.middle * b.middle, std::abs(a.middle) * b.radius + a.radius * b.largest_length()};
}
// The radius of a product of two vectors, of either kind.
inline double radius_of_product(const Ball &a, const Ball &b) {
  return length(a.middle) * b.radius + a.radius * b.largest_length();
}
inline Interval dot(const Ball &a, const Ball &b) { return {dot(a.middle, b.middle), radius_of_product(a, b)}; }
inline Ball cross(const Ball &a, const Ball &b) { return {cross(a.middle, b.middle), radius_of_product(a, b)}; }
inline Interval square(const Ball &a) {
  const double least = std::max(a.least_length(), 0.0), largest = a.largest_length();
  return Interval::between(least * least, largest * largest);
}

// Inverts positive numbers.
inline Interval inverse(double least, double largest) { return Interval::between(1 / largest, 1 / least); }

// Returns a's part across unit vectors. The projections across two unit vectors differ by the sine of the angle between them,
// which is at most the distance between the unit vectors.
inline Ball across(const Ball &a, const Ball &unit) {
  return {a.middle - dot(a.middle, unit.middle) * unit.middle, a.radius + length(a.middle) * unit.radius};
}

// Returns the unit vectors of vectors whose least length is positive. No vector of the ball turns away from the middle by an
// angle whose sine exceeds radius / length. The distance between two unit vectors is less than the tangent of the angle between
// them.
inline Ball unit(const Ball &a) {
  const double size = length(a.middle);
  return {(1 / size) * a.middle, a.radius / std::sqrt((size - a.radius) * (size + a.radius))};
}

}  // namespace riis
