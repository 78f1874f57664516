// SPDX-License-Identifier: Apache-2.0
// riis check crossings, and a shorter check of every shape that the user chose. In: a valve or its surface. Out: the first
// opening at which its leaflets go through each other.
#pragma once

#include <riis/riis.h>

#include <optional>
#include <string>

#include "program/options.hpp"
#include "program/report.hpp"

namespace riis::program {

// Checks 101 openings if the valve opens and the user gave no opening, and otherwise the surface as it is. Writes
// report.crossings, and warns on stderr of a crossing. valve is null for a surface from a file.
void look_for_crossings(const ValveOptions &options, const riis_valve *valve, const riis_surface *surface,
                        Report &report);

// Checks those of the openings 0, 0.5 and 1 that the valve can have, and warns of a crossing. A default shape is not checked.
// has_open_state: the user chose the open state. part goes before the warning if there are several valves.
std::optional<CrossingReport> check_shape(const ValveOptions &options, const riis_valve *valve, bool has_open_state,
                                          const std::string &part = "");

}  // namespace riis::program
