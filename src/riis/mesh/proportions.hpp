// SPDX-License-Identifier: Apache-2.0
// Checks whether a mesh, a surface and its half thickness can be in the same unit.
// In: boxes that are known already. Out: a warning to the caller's log function, once for each pair of a mesh and a surface.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "geometry/bounds.hpp"

namespace riis {

// The surfaces that were reported as misfits for a mesh. Several threads may call both functions at once.
class WarnedSurfaces {
 public:
  // Records the number, which must not be 0. Returns true if it is new. Once the list is full, also returns false for new
  // numbers.
  bool is_first(std::uint64_t surface_number);
  bool has(std::uint64_t surface_number) const;

 private:
  static constexpr std::size_t capacity = 8;
  std::array<std::atomic<std::uint64_t>, capacity> numbers_{};
};

struct Sizes {
  std::int64_t n_nodes;
  Bounds mesh, surface;
  double half_thickness;
};

// Takes a few comparisons for a mesh of any size. Compares sizes and not positions, because one process's part of a mesh may lie
// far from the surface.
void check_proportions(const Sizes &sizes, std::uint64_t surface_number, WarnedSurfaces &warned);

}  // namespace riis
