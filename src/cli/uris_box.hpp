// SPDX-License-Identifier: Apache-2.0
// svMultiPhysics looks at nodes only in the box of a valve's nodes, which it widens by a tenth. The band of a flat valve and the
// bands in which the solver takes its pressures are outside. In: the triangles. Out: three more triangles that widen the box.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cli/finer_triangles.hpp"

namespace riis::cli {

// Returns the power of two whose multiples the coordinates have to be, by the largest of them. Sums of three are then exact, in
// a box that is up to some ten times larger.
double uris_grid(double largest);

// A triangle for each axis. Its middle is exactly that of a triangle of the valve, so the solver never finds it nearer. Its
// corners reach beyond both sides of the box.
class UrisBox {
 public:
  static constexpr std::int64_t n_nodes = 9;

  // Chooses triangles of the valve that lie half way between the sides, in the first and the last frame. Coordinates are
  // multiples of grid.
  UrisBox(std::vector<Corners> triangles, const std::vector<double> &first, const std::vector<double> &last,
          double half_thickness, double grid);

  // Appends the three corners of each axis' triangle to a frame.
  void append_nodes(std::vector<double> &xyz) const;

 private:
  std::vector<Corners> triangles_;
  double half_thickness_, grid_;
  std::array<std::size_t, 3> chosen_{};
};

}  // namespace riis::cli
