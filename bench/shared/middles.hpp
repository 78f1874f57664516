// SPDX-License-Identifier: Apache-2.0
// Marks by the rule of svMultiPhysics: a node's distance is the distance to the nearest middle of a triangle.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "references.hpp"

namespace bench {

// Returns the middles of all triangles, (3, n). The middle of a triangle is the mean of its corners.
inline std::vector<double> middles_of(const Triangles &triangles) {
  std::vector<double> middles;
  for (std::int64_t i = 0; i < triangles.n(); ++i) {
    const double *c = triangles.corners.data() + 9 * i;
    for (int k = 0; k < 3; ++k) middles.push_back((c[k] + c[3 + k] + c[6 + k]) / 3);
  }
  return middles;
}

// Measures the distance of each node to all middles, as svMultiPhysics does. distance: (n_nodes); xyz: (3, n_nodes).
inline void distances_to_middles(const std::vector<double> &middles, std::int64_t n_nodes, const double *xyz,
                                 double *distance) {
  const double *const end = middles.data() + middles.size();
  for (std::int64_t i = 0; i < n_nodes; ++i) {
    const double *p = xyz + 3 * i;
    double least = std::numeric_limits<double>::infinity();
    for (const double *m = middles.data(); m != end; m += 3) {
      const double x = p[0] - m[0], y = p[1] - m[1], z = p[2] - m[2];
      least = std::min(least, x * x + y * y + z * z);
    }
    distance[i] = std::sqrt(least);
  }
}

}  // namespace bench
