// SPDX-License-Identifier: Apache-2.0
// A box along the axes.
#pragma once

#include <algorithm>
#include <limits>

namespace riis::program {

struct Box {
  double lower[3], upper[3];

  double largest_side() const { return std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]}); }
  void grow(const double *least, const double *most) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], least[k]);
      upper[k] = std::max(upper[k], most[k]);
    }
  }
  void grow(const double *point) { grow(point, point); }
  void grow(const Box &other) { grow(other.lower, other.upper); }
  bool meets(const double *other_lower, const double *other_upper) const {
    for (int k = 0; k < 3; ++k)
      if (upper[k] < other_lower[k] || lower[k] > other_upper[k]) return false;
    return true;
  }
};

// Returns a box that contains nothing.
inline Box empty_box() {
  constexpr double far = std::numeric_limits<double>::infinity();
  return {{far, far, far}, {-far, -far, -far}};
}

}  // namespace riis::program
