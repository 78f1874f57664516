// SPDX-License-Identifier: Apache-2.0
// The input is a mesh with a placed valve. The results are a point in the blood upstream of the valve, a point downstream, and
// the side of the valve on which each end lies.
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

// `marking` has the options of the valve, with its skirt and its half thickness. `centre` is the middle of the annulus, and
// `flow` is the direction of the blood. `millimetre` is the length of a millimetre in the mesh's unit. Refuses a mesh that has no
// room for the two points.
ValveSides sides_of_valve(const std::string &mesh, const MarkOptions &marking, const std::vector<Boundary> &boundaries,
                          const std::array<double, 3> &centre, const std::array<double, 3> &flow, double millimetre);

}  // namespace riis::program
