// SPDX-License-Identifier: Apache-2.0
// Implements riis check crossings, and a shorter check of every shape that the user chose.
// In: a valve or its surface. Out: the first opening at which leaflets go through each other.
#pragma once

#include <riis/riis.h>

#include <optional>
#include <string>

#include "program/base/options.hpp"
#include "program/output/report.hpp"

namespace riis::program {

// Checks 101 openings if the valve can open and the user gave no opening. Otherwise checks the surface itself. Warns on stderr of
// a crossing. `valve` is null for a surface from a file. If there are several valves, `part` begins the warning.
CrossingReport look_for_crossings(const ValveOptions &options, const riis_valve *valve, const riis_surface *surface,
                                  const std::string &part);

// Checks each of the openings 0, 0.5 and 1 that the valve can have, and warns of a crossing. Does not check a default shape.
// has_open_state tells whether the user chose the open state.
std::optional<CrossingReport> check_shape(const ValveOptions &options, const riis_valve *valve, bool has_open_state,
                                          const std::string &part = "");

}  // namespace riis::program
