// SPDX-License-Identifier: Apache-2.0
// Joins numbers into disjoint sets. Also numbers points, so that points at the same place have the same number.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include "common/array_view.hpp"

namespace riis {

// Sets of numbers from 0 to n - 1. At first each number is a set by itself.
class DisjointSets {
 public:
  explicit DisjointSets(std::int64_t n) : parent_(static_cast<std::size_t>(n)) {
    std::iota(parent_.begin(), parent_.end(), std::int64_t{0});
  }
  // Adds the next number as a set by itself.
  void add() { parent_.push_back(static_cast<std::int64_t>(parent_.size())); }
  // Returns the least number of the set that contains i.
  std::int64_t root(std::int64_t i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }
  // Unites the sets of two numbers. Returns whether these sets were different.
  bool unite(std::int64_t a, std::int64_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return false;
    parent(std::max(a, b)) = std::min(a, b);
    return true;
  }

 private:
  std::int64_t &parent(std::int64_t i) { return view(parent_)[i]; }
  std::vector<std::int64_t> parent_;
};

// Returns a number from 0 to n - 1 for each of n points, xyz(3, n). Two points have the same number if and only if their
// coordinates are exactly equal. A file may contain NaN, so coordinates are compared by their bits. 0 and -0 count as equal.
inline std::vector<std::int64_t> equal_places(std::int64_t n, const double *xyz) {
  const auto place_of = [xyz](std::int64_t point) {
    std::array<std::uint64_t, 3> bits{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double coordinate = xyz[3 * point + static_cast<std::int64_t>(k)] + 0.0;
      std::memcpy(&bits[k], &coordinate, sizeof coordinate);
    }
    return bits;
  };
  std::vector<std::int64_t> order(static_cast<std::size_t>(n)), places(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), std::int64_t{0});
  std::sort(order.begin(), order.end(), [&](std::int64_t a, std::int64_t b) { return place_of(a) < place_of(b); });
  for (std::int64_t i = 1; i < n; ++i) {
    const std::int64_t before = view(order)[i - 1], here = view(order)[i];
    view(places)[here] = view(places)[before] + (place_of(here) == place_of(before) ? 0 : 1);
  }
  return places;
}

}  // namespace riis
