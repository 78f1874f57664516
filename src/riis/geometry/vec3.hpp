// SPDX-License-Identifier: Apache-2.0
// A point or vector of R^3 in double precision.
#pragma once

#include <cmath>
#include <cstdint>

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

// Writes entry i of an array (3, n).
inline void put_vector(double *list, std::int64_t i, Vec3 value) {
  list[3 * i] = value.x;
  list[3 * i + 1] = value.y;
  list[3 * i + 2] = value.z;
}

}  // namespace riis
