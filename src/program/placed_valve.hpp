// SPDX-License-Identifier: Apache-2.0
// A placed valve: a JSON file of riis place, with the kind, the parameters and the placement of a patient's valve. Every command
// takes it as --valve FILE.json.
#pragma once

#include <string>
#include <vector>

#include "program/json.hpp"
#include "program/options.hpp"

namespace riis::program {

// If --valve is the file of a placed valve, replaces the options for kind and placement by those of the file.
// set_placed_parameters sets the file's parameters. Refuses options that the file already contains. Leaves other valves as they
// are.
void use_placed_valve(ValveOptions &options);
const std::vector<std::string> &placed_keys();
void set_placed_parameters(const ValveOptions &options, riis_valve *valve);

}  // namespace riis::program
