// SPDX-License-Identifier: Apache-2.0
// Points and vectors of R^3 in double precision, and boxes whose sides are parallel to the coordinate axes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "common/elementary.hpp"

namespace riis {

struct Vec3 {
  double x, y, z;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline bool operator==(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline double distance(Vec3 a, Vec3 b) { return length(b - a); }
inline Vec3 mix(Vec3 a, Vec3 b, double t) { return (1.0 - t) * a + t * b; }
inline double largest_coordinate(Vec3 a) { return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}); }

// Writes entry i of an array (3, n).
inline void put_vector(double *list, std::int64_t i, Vec3 value) {
  list[3 * i] = value.x;
  list[3 * i + 1] = value.y;
  list[3 * i + 2] = value.z;
}

// The box is empty until a point or another box is added.
struct Bounds {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  Vec3 lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};

  void add(Vec3 p) { add({p, p}); }
  void add(const Bounds &other) {
    lower = {std::min(lower.x, other.lower.x), std::min(lower.y, other.lower.y), std::min(lower.z, other.lower.z)};
    upper = {std::max(upper.x, other.upper.x), std::max(upper.y, other.upper.y), std::max(upper.z, other.upper.z)};
  }

  // Coordinates are halved before they are added, so that the sum of two large coordinates does not overflow.
  Vec3 middle() const { return 0.5 * lower + 0.5 * upper; }
  Vec3 half_extent() const { return 0.5 * upper - 0.5 * lower; }

  double largest_coordinate() const {
    return std::max(riis::largest_coordinate(lower), riis::largest_coordinate(upper));
  }

  // Returns the square of the distance from p to the box. The result is at most dot(q - p, q - p) for any point q in the box. The
  // computed numbers obey this bound also, because rounding never reverses the order of two differences, squares or sums.
  double distance_sq_to(Vec3 p) const {
    const auto outside = [](double x, double least, double most) { return std::max({least - x, x - most, 0.0}); };
    const Vec3 away{outside(p.x, lower.x, upper.x), outside(p.y, lower.y, upper.y), outside(p.z, lower.z, upper.z)};
    return dot(away, away);
  }
};

// Returns true if the boxes have a point in common.
inline bool overlap(const Bounds &a, const Bounds &b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
         a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

}  // namespace riis
