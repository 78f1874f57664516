// SPDX-License-Identifier: Apache-2.0
// In: a JSON file or NAME=VALUE. Out: parameters of a valve, with the names that riis_valve_set accepts. json_template makes
// such a file from a valve.
#pragma once

#include <riis/riis.h>

#include <string>

#include "program/input/json.hpp"

namespace riis::program {

// Reads, for example, {"root_radius": 1.29, "right": {"leaflet_angle": 61}, "left.leaflet_angle": 58.5}. Names without a part
// are set first, so the order in the file does not matter. Refused are a repeated name, and two names of one size, such as
// "annulus" and "root_radius".
void set_from_json_file(riis_valve *valve, const std::string &path);

// Sets parameters from a JSON value, as from a file. `path`, a file or a position in one, begins refusals.
void set_from_json(riis_valve *valve, const Json &parameters, const std::string &path);

// Sets the parameter of one --set.
void set_from_text(riis_valve *valve, const std::string &setting);

// Returns all parameters of the valve with their values. Reading these values back sets all parameters, so no parameter follows
// from others. Of the bumps at no place, only bump_0 is shown.
std::string json_template(const riis_valve *valve);
// Returns the parameters as a table for people. Each line has a parameter's name, value, unit, range and description. One line
// stands for all like parts, such as bumps.
std::string parameter_table(const riis_valve *valve);

}  // namespace riis::program
