// SPDX-License-Identifier: Apache-2.0
// The caller's points, borrowed as three pointers and a stride, and the checks of their coordinates.
#pragma once

#include <riis/riis.h>

#include <cmath>
#include <cstdint>

#include "geometry/vec3.hpp"

namespace riis {

template <class Real>
struct StridedReals {
  std::int64_t n;
  const Real *x, *y, *z;
  std::int64_t stride;

  Vec3 operator[](std::int64_t i) const { return {x[i * stride], y[i * stride], z[i * stride]}; }
  // Asks the processor to load a point's coordinates before they are read.
  void prefetch(std::int64_t i) const {
    for (const Real *coordinate : {x + i * stride, y + i * stride, z + i * stride}) __builtin_prefetch(coordinate);
  }
};
using StridedPoints = StridedReals<double>;

// Calls use(points) with the points in the precision that the caller stated.
template <class Use>
auto with_points(std::int64_t n, const void *const (&xyz)[3], std::int64_t stride, std::int32_t real_bits,
                 const Use &use) {
  const auto of = [&](auto real) {
    using Real = decltype(real);
    return StridedReals<Real>{n, static_cast<const Real *>(xyz[0]), static_cast<const Real *>(xyz[1]),
                              static_cast<const Real *>(xyz[2]), stride};
  };
  return real_bits == 32 ? use(of(0.0f)) : use(of(0.0));
}

// Distances are computed with fourth powers of coordinates and edges. Within these limits, the powers stay within the range of
// doubles.
inline constexpr double max_coordinate = 1e60, min_edge = 1e-60;

// Returns whether a coordinate is finite and not too large. Returns false for NaN.
inline bool is_usable(double coordinate) { return std::abs(coordinate) <= max_coordinate; }
inline bool is_usable(Vec3 p) { return is_usable(p.x) && is_usable(p.y) && is_usable(p.z); }

// Checks pointers, stride and every coordinate. Returns the box of the points. Fails with RIIS_INVALID_ARGUMENT, or with
// bad_coordinate for the first unusable coordinate. The message of such a failure names the point by `what` ("node", "point") and
// its number. `prefix`, such as "points.", precedes the names of arguments in messages. Uses only the calling thread: more
// threads would save no time, and the caller may not want them.
template <class Real>
Bounds check_points(const StridedReals<Real> &points, const char *what, riis_status bad_coordinate,
                    const char *prefix = "");

// Checks only the pointers and the stride, and that the components are apart.
template <class Real>
void check_pointers(const StridedReals<Real> &points, const char *what, const char *prefix = "");

// The names of three components and of their stride in messages. `prefix` precedes each name.
struct ComponentNames {
  const char *prefix, *names[3], *stride;
};
// Refuses components that overlap because the stride is wrong: one component begins inside another component, but after the first
// stride of this other component. Examples are one array xyz with the stride 1, and separate arrays with the stride 3. Equal
// components are allowed if `may_be_equal`, because one array may serve two axes. The caller has already checked n and the
// stride. The stride counts numbers of `size` bytes.
void check_apart(std::int64_t n, const void *const (&components)[3], std::int64_t stride, std::int64_t size,
                 const ComponentNames &names, bool may_be_equal = true);

// Checks one point as check_points does.
template <class Real>
void check_point(const StridedReals<Real> &points, std::int64_t i, const char *what, riis_status bad_coordinate);

// Returns point i, and checks it again. The points were checked when the caller passed them, but the caller may have changed
// coordinates since then. Fails as check_points does.
inline Vec3 checked_point(const StridedPoints &points, std::int64_t i, const char *what, riis_status bad_coordinate) {
  const Vec3 p = points[i];
  if (!is_usable(p)) check_points(points, what, bad_coordinate);
  return p;
}

}  // namespace riis
