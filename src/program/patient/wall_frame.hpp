// SPDX-License-Identifier: Apache-2.0
// In: a patient's wall, whose file states neither unit nor axes, and landmarks, whose file states both. Out: the unit and the
// axes with which the landmarks lie at the wall.
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

// The wall has the lengths of its file. `unit` and `axes` are the user's statements, if any. Refuses landmarks that are not at
// the wall, and asks if two units or axes fit about equally well.
WallFrame frame_of_wall(const PatientWall &wall, const LandmarkFile &landmarks, std::optional<Unit> unit,
                        const std::string &axes);

}  // namespace riis::program
