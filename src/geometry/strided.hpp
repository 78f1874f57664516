// SPDX-License-Identifier: Apache-2.0
// The caller's points where they lie: three pointers and a stride.
#pragma once

#include <cmath>
#include <cstdint>

#include "geometry/vec3.hpp"

namespace riis {

struct StridedPoints {
  std::int64_t n;
  const double *x, *y, *z;
  std::int64_t stride;

  Vec3 operator[](std::int64_t i) const { return {x[i * stride], y[i * stride], z[i * stride]}; }
};

// Coordinates that the kernels can take: finite, and small enough for fourth powers.
inline bool is_usable(Vec3 p, double max_magnitude) {
  return std::abs(p.x) <= max_magnitude && std::abs(p.y) <= max_magnitude && std::abs(p.z) <= max_magnitude;
}

}  // namespace riis
