// SPDX-License-Identifier: Apache-2.0
// svMultiPhysics looks at a mesh only in the box of the valve's nodes, widened by a tenth. A flat valve's box is too thin: it
// leaves out marks, and the bands in which the solver takes its pressures. In: the triangles. Out: three more,
// which widen the box.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "program/finer_triangles.hpp"

namespace riis::program {

// Returns the power of two to whose multiples coordinates are rounded; `largest` is the largest of them. Sums of three are then
// exact, even in a box some ten times larger.
double uris_grid(double largest);

// A triangle along each axis. Its middle is exactly that of a triangle of the valve, so the solver never finds it nearer. Its
// corners reach beyond the box at both ends.
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

}  // namespace riis::program
