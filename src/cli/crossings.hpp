// SPDX-License-Identifier: Apache-2.0
// --check-crossing. In: a valve or its surface. Out: the first of its openings at which it goes through itself.
#pragma once

#include <riis/riis.h>

#include "cli/command_line.hpp"
#include "cli/report.hpp"

namespace riis::cli {

// Looks at 101 openings of a valve that opens, unless the user gave one, otherwise at the surface. Writes report.crossings, and
// warns on stderr of a crossing. valve is null for a surface from a file.
void look_for_crossings(const Options &options, const riis_valve *valve, riis_surface *surface, Report &report);

}  // namespace riis::cli
