// SPDX-License-Identifier: Apache-2.0
// Collects the lengths of a mesh's edges in the band. The library uses this code for its caller's mesh, and the program uses it
// for the pieces of a mesh.
#pragma once

#include <riis/riis.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace riis {

template <class Sum>
struct EdgeLengths {
  std::int64_t n = 0;
  Sum sum = 0;
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;

  void add(double length) { add({1, length, length, length}); }
  void add(const EdgeLengths &other) {
    n += other.n;
    sum += other.sum;
    shortest = std::min(shortest, other.shortest);
    longest = std::max(longest, other.longest);
  }
  // Returns how many edges fit across the band.
  riis_cells_across across(double half_thickness) const {
    if (n == 0) return {0, 0, 0, 0, 0, 0, half_thickness, 0};
    // Because of rounding, the computed mean could lie outside the range of the lengths, even if all lengths are equal. The mean
    // is therefore limited to this range.
    const double mean = std::clamp(static_cast<double>(sum / static_cast<Sum>(n)), shortest, longest);
    const double band = 2 * half_thickness;
    return {band / longest, band / mean, band / shortest, shortest, mean, longest, half_thickness, n};
  }
};

}  // namespace riis
