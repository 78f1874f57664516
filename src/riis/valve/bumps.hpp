// SPDX-License-Identifier: Apache-2.0
// Bumps: disease at one place of a free edge (docs/theory/bumps.md). A bump changes how far the edge closes and opens at its
// place. This file computes both for each place of the edge, from the parameters of the bumps.
#pragma once

#include <array>
#include <cstddef>

#include "base/recycled.hpp"
#include "valve/valve.hpp"

namespace riis {

inline constexpr std::size_t n_bumps = 6;

enum class BumpLift : bool { no, yes };

// Appends the parameters of all bumps, and returns the position of the first parameter. Only bumps with BumpLift::yes have
// "lift".
std::size_t add_bump_specs(Vector<ParameterSpec> &specs, std::size_t n_leaflets, BumpLift lift);

// The closed and the open position of a place of a free edge. Both are shares of the way of a healthy place: 0 is its closed
// position, and 1 is its open position. `lift` raises the closed position towards +z.
struct LocalOpening {
  double closed = 0, open = 1, lift = 0;
};

class Bumps {
 public:
  // `first` is the position of the first parameter. Fails with RIIS_INVALID_PARAMETER if the number of a leaflet or of a
  // commissure is not whole, or if a bump has both numbers.
  Bumps(const ParameterValues &values, std::size_t first, std::size_t n_leaflets, BumpLift lift);

  // Returns whether some bump has a place.
  bool any() const;
  // u is the position along the leaflet's free edge, counter-clockwise seen from +z. Leaflet k runs from commissure k - 1 (u = 0)
  // to commissure k (u = 1). At a commissure itself, only bumps of commissures act, and they act equally on both neighbours.
  LocalOpening at(std::size_t leaflet, double u) const;

 private:
  struct Bump {
    double leaflet, commissure, u, width, closed, open, lift;

    double weight(std::size_t of_leaflet, std::size_t n_leaflets, double at_u) const;
  };
  std::array<Bump, n_bumps> bumps_{};
  std::size_t n_leaflets_;
};

}  // namespace riis
