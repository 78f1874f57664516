// SPDX-License-Identifier: Apache-2.0
// Checks whether a mesh, a surface and its half thickness can be in one unit.
// In: boxes that are known anyway. Out: a warning to the caller's log function, once for a mesh and a surface.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "geometry/bounds.hpp"

namespace riis {

// The surfaces that a mesh was warned about. Several threads may call both functions at once.
class WarnedSurfaces {
 public:
  // Returns true once for every number other than 0. Returns false for every new number once the list is full.
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

// Makes a few comparisons, whatever the size of the mesh. Compares sizes only, not places: a rank's part of a mesh may be
// elsewhere.
void check_proportions(const Sizes &sizes, std::uint64_t surface_number, WarnedSurfaces &warned);

}  // namespace riis
