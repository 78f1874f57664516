// SPDX-License-Identifier: Apache-2.0
// In: a valve with bumps (docs/theory/bumps.md), and the band around it. Out: a warning if the band closes the gap that the bumps
// leave in the closed valve.
#pragma once

#include <riis/riis.h>

#include <string>

#include "program/base/options.hpp"

namespace riis::program {

// Warns if bumps leave a gap in the closed valve that is nowhere wider than the bridge between two bands. The gap is that of the
// orifice, seen along its axis. The slits that the valve also has without bumps do not count. `part` begins the warning.
void warn_of_bridged_gap(const ValveOptions &options, const riis_valve *valve, const std::string &part);

}  // namespace riis::program
