// SPDX-License-Identifier: Apache-2.0
// The landmarks of each kind of valve: which there must be, where they lie on the valve, and the sizes that they determine.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "landmarks/fit.hpp"
#include "landmarks/landmarks.hpp"
#include "valve/valve.hpp"

namespace riis {

// Returns a parameter's value in the template. The template is the valve whose proportions the fit begins with.
double value_of(const Valve &valve, const std::string &name, std::size_t component = 0);

struct KindOfLandmarks {
  std::unique_ptr<LandmarkModel> model;
  std::vector<Pose> starts;
  const char *size_name;  // the parameter that stands for the valve's size
  // Sets parameters that are not lengths, and lengths that do not grow with the valve's size. The lengths and the model's sizes
  // have been set. `own` is the template valve. NULL: there is nothing to set.
  void (*finish)(const Valve &own, Valve &valve);
  // Refuses a fit that leaves something undetermined. NULL: no fit is refused.
  void (*check)(const LandmarkModel &fitted, const Landmarks &landmarks) = nullptr;
};

// Checks the landmarks and prepares the fit, for the kinds with cusps: trileaflet and aortic.
KindOfLandmarks cusp_landmarks(const Valve &valve, const Landmarks &landmarks);
KindOfLandmarks mitral_landmarks(const Valve &valve, const Landmarks &landmarks);
KindOfLandmarks bileaflet_landmarks(const Valve &valve, const Landmarks &landmarks);

}  // namespace riis
