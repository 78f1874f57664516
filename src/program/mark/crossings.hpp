// SPDX-License-Identifier: Apache-2.0
// Implements riis check crossings, and a shorter check for shapes that the user chose.
// The input is a valve or its surface. The result is the first opening at which leaflets cross.
#pragma once

#include <riis/riis.h>

#include <optional>
#include <string>

#include "program/base/options.hpp"
#include "program/output/report.hpp"

namespace riis::program {

// Checks 101 openings if the valve can open and the user chose no opening. If the valve cannot open, or the user chose an
// opening, checks only the given surface. Warns on stderr of a crossing. For a surface from a file, `valve` is null. If there are
// several valves, the warning begins with `part`.
CrossingReport look_for_crossings(const ValveOptions &options, const riis_valve *valve, const riis_surface *surface,
                                  const std::string &part);

// Checks the openings 0, 0.5 and 1, as far as the valve can have them, and warns of a crossing. A default shape is not checked.
// `has_open_state` tells whether the user chose the open state.
std::optional<CrossingReport> check_shape(const ValveOptions &options, const riis_valve *valve, bool has_open_state,
                                          const std::string &part = "");

}  // namespace riis::program
