// SPDX-License-Identifier: Apache-2.0
// In: a mesh with a placed valve. Out: a point in the blood before the valve and one after it, and on which side the ends are.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "program/base/options.hpp"
#include "program/patient/solver_case.hpp"

namespace riis::program {

struct ValveSides {
  std::array<double, 3> upstream{}, downstream{};
  double ball_radius = 0;  // of balls around the two points that meet neither the wall nor the band at any opening
  bool are_apart = false;  // whether the closed valve parts the unmarked nodes on its two sides
  std::vector<std::string> before, after;  // the ends on either side, if the sides are apart
};

// `marking` has the valve with its skirt and its half thickness. `centre` is the middle of the annulus, and `flow` the direction
// of the blood. `millimetre` is its length in the mesh. Refuses a mesh without room for the points.
ValveSides sides_of_valve(const std::string &mesh, const MarkOptions &marking, const std::vector<Boundary> &boundaries,
                          const std::array<double, 3> &centre, const std::array<double, 3> &flow, double millimetre);

}  // namespace riis::program
