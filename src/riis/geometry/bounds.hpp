// SPDX-License-Identifier: Apache-2.0
// A box whose sides are parallel to the coordinate axes.
#pragma once

#include <algorithm>
#include <limits>

#include "geometry/vec3.hpp"

namespace riis {

// The box is empty until a point or a box is added.
struct Bounds {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  Vec3 lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};

  void add(Vec3 p) { add({p, p}); }
  void add(const Bounds &other) {
    lower = {std::min(lower.x, other.lower.x), std::min(lower.y, other.lower.y), std::min(lower.z, other.lower.z)};
    upper = {std::max(upper.x, other.upper.x), std::max(upper.y, other.upper.y), std::max(upper.z, other.upper.z)};
  }

  // Coordinates are halved before they are added, so that the sum of two large ones does not overflow.
  Vec3 middle() const { return 0.5 * lower + 0.5 * upper; }
  Vec3 half_extent() const { return 0.5 * upper - 0.5 * lower; }
};

// Returns true if the boxes have a point in common.
inline bool overlap(const Bounds &a, const Bounds &b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
         a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

}  // namespace riis
