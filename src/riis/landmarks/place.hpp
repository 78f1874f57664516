// SPDX-License-Identifier: Apache-2.0
// Sets a valve's sizes from a patient's landmarks, and finds its placement (docs/theory/landmarks.md).
// In: landmarks, and a valve whose proportions are the template. Out: the valve of the patient, its placement and the residuals.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/vec3.hpp"
#include "landmarks/landmarks.hpp"
#include "valve/valve.hpp"

namespace riis {

struct PlacedValve {
  Valve valve;
  double scale;
  Vec3 rotation_axis;
  double rotation_angle;          // degrees
  Vec3 translation;               // mesh units
  std::vector<double> residuals;  // residuals of the landmarks, mesh units
  std::vector<Vec3> places;       // the landmarks' places on the closed valve, mesh units
  double noise;                   // the noise on which standard errors rest, mesh units
  double rotation_error;          // degrees
  double position_error;          // standard error of the valve's origin, mesh units
  // One entry for each parameter of the kind.
  std::vector<std::int32_t> size_state;  // RIIS_SIZE_*
  std::vector<double> standard_error;    // infinite for RIIS_SIZE_TIED, 0 for RIIS_SIZE_KEPT
};

// `held` names sizes that keep the valve's values, separated by blanks or commas.
PlacedValve place_valve(const Valve &valve, const Landmarks &landmarks, std::string_view held);

}  // namespace riis
