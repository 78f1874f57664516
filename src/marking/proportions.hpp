// SPDX-License-Identifier: Apache-2.0
// Whether a mesh, a surface and its half thickness can be in one unit.
// In: boxes that are known anyway. Out: a warning to the caller's log function, once for a mesh and a surface.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "geometry/bounds.hpp"

namespace riis {

// The surfaces that a mesh was warned of. Several threads may ask at once.
class Warned {
 public:
  // True once for every number other than 0, until there are more than fit: then false.
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

// Makes a few comparisons, whatever the size of the mesh. Only sizes are compared: a rank's part of a mesh may be elsewhere.
void check_proportions(const Sizes &sizes, std::uint64_t surface_number, Warned &warned);

}  // namespace riis
