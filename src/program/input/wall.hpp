// SPDX-License-Identifier: Apache-2.0
// In: --skirt and --wall. Out: the skirt of a valve, up to a wall, and the gap between the valve and the wall.
#pragma once

#include <riis/riis.h>

#include <string>

#include "program/base/handles.hpp"
#include "program/base/options.hpp"

namespace riis::program {

// Gives the valve the skirt of --skirt and --wall. Does nothing without --skirt. `subject` begins refusals that are not about the
// wall. Refuses a wall that is farther away than --skirt at any opening. Warns of holes in the wall.
void set_skirt(const ValveOptions &options, riis_valve *valve, const std::string &subject);
// Makes the surface of --wall.
Surface wall_of(const ValveOptions &options);
// Measures the gap between a valve's surface and the wall of --wall.
riis_gap gap_to_wall(const ValveOptions &options, const riis_surface *surface);

}  // namespace riis::program
