// SPDX-License-Identifier: Apache-2.0
// riis check crossings, and a shorter look at every shape that the user chose. In: a valve or its surface. Out: the first of its
// openings at which it goes through itself.
#pragma once

#include <riis/riis.h>

#include <optional>
#include <string>

#include "program/options.hpp"
#include "program/report.hpp"

namespace riis::program {

// Looks at 101 openings of a valve that opens, unless the user gave one, otherwise at the surface. Writes report.crossings, and
// warns on stderr of a crossing. valve is null for a surface from a file.
void look_for_crossings(const ValveOptions &options, const riis_valve *valve, const riis_surface *surface,
                        Report &report);

// Looks at openings 0, 0.5 and 1, as far as the valve can be there, and warns of a crossing. A default shape is not looked at.
// has_open_state: the user chose another state to open to. part goes before the warning of one valve of several.
std::optional<CrossingReport> check_shape(const ValveOptions &options, const riis_valve *valve, bool has_open_state,
                                          const std::string &part = "");

}  // namespace riis::program
