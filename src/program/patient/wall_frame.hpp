// SPDX-License-Identifier: Apache-2.0
// The inputs are a patient's wall from a file that states neither a unit nor axes, and landmarks from a file that states both.
// The results are the unit and the axes with which the landmarks lie at the wall.
#pragma once

#include <optional>
#include <string>

#include "program/input/placing.hpp"
#include "program/patient/flat_ends.hpp"

namespace riis::program {

struct WallFrame {
  Unit unit = Unit::millimetre;
  std::string axes;      // "LPS", "RAS" or "mesh"
  double away = 0;       // mean distance of the landmarks from the wall, in millimetres
  double worst = 0;      // the largest of these distances
  std::string farthest;  // the landmark with this distance
};

// The lengths of the wall are in the unit of its file. `unit` and `axes` are given if the user stated them. Refuses landmarks
// that are not at the wall. If two units or axes fit about equally well, refuses to choose one of them.
WallFrame frame_of_wall(const PatientWall &wall, const LandmarkFile &landmarks, std::optional<Unit> unit,
                        const std::string &axes);

}  // namespace riis::program
