// SPDX-License-Identifier: Apache-2.0
// The input is a JSON file or NAME=VALUE. The results are parameters of a valve, with the names that riis_valve_set accepts.
// json_template writes such a JSON file for a valve.
#pragma once

#include <riis/riis.h>

#include <string>

#include "program/input/json.hpp"

namespace riis::program {

// Reads parameters such as {"root_radius": 1.29, "right": {"leaflet_angle": 61}, "left.leaflet_angle": 58.5}. Parameters without
// a part's name are set first, so the order in the file does not matter. Refuses a repeated name, and two names of one parameter,
// such as "annulus" and "root_radius".
void set_from_json_file(riis_valve *valve, const std::string &path);

// Sets parameters from the JSON value of a file or of a case. Refusals begin with `path`, which is a file or a position in a
// file.
void set_from_json(riis_valve *valve, const Json &parameters, const std::string &path);

// Sets the parameter that one option --set names.
void set_from_text(riis_valve *valve, const std::string &setting);

// Returns all parameters of the valve with their values. If these values are read again, they set every parameter. No parameter
// then follows from another parameter. Bumps that have no place are left out, except bump_0.
std::string json_template(const riis_valve *valve);
// Returns the parameters as a table for the user to read. Each line has a parameter's name, value, unit, range and description.
// One line stands for all parts that are alike, such as bumps.
std::string parameter_table(const riis_valve *valve);

}  // namespace riis::program
