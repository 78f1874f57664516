// SPDX-License-Identifier: Apache-2.0
// Vectors of three numbers.
#pragma once

#include <array>

#include "common/elementary.hpp"

namespace riis {

using Vector3 = std::array<double, 3>;

inline Vector3 operator+(const Vector3 &a, const Vector3 &b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vector3 operator-(const Vector3 &a, const Vector3 &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector3 operator*(double factor, const Vector3 &a) { return {factor * a[0], factor * a[1], factor * a[2]}; }
inline double dot(const Vector3 &a, const Vector3 &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector3 cross(const Vector3 &a, const Vector3 &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Vector3 &a) { return hypotenuse(a[0], a[1], a[2]); }
// Returns the vector scaled to length 1. Returns (0, 0, 0) for (0, 0, 0).
inline Vector3 unit_vector(const Vector3 &a) {
  const double length = norm(a);
  return length > 0 ? 1 / length * a : Vector3{};
}
// Returns the vector, turned about an axis of any length above 0 (Rodrigues' formula).
inline Vector3 turned(const Vector3 &vector, const Vector3 &axis, double degrees) {
  const Vector3 unit = unit_vector(axis);
  const auto [sine, cosine] = sine_cosine_degrees(degrees);
  return cosine * vector + sine * cross(unit, vector) + (1 - cosine) * dot(unit, vector) * unit;
}

}  // namespace riis
