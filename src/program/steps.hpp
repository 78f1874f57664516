// SPDX-License-Identifier: Apache-2.0
// --steps: the cost of a time step of a moving valve, once the mesh is prepared for many markings.
#pragma once

#include <riis/riis_vtk.h>

#include <cstdint>

#include "program/command_line.hpp"

namespace riis::program {

// The medians of the steps.
struct StepTimes {
  std::int32_t n_steps;
  std::int32_t search;      // RIIS_SEARCH_*
  double surface, marking;  // seconds
};

// The opening's way in a step: the valve opens within 50 steps.
inline constexpr double opening_of_step = 0.02;

// Moves the opening to and fro between 0 and 1 and marks the nodes of the file after each step. Afterwards the valve is as
// before. Other surfaces and results do not change. Throws a Refusal for a valve that cannot move.
StepTimes time_steps(const Options &options, riis_valve *valve, const riis_vtk_mesh *file);

}  // namespace riis::program
