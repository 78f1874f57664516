// SPDX-License-Identifier: Apache-2.0
// In: a JSON file or NAME=VALUE. Out: parameters of a valve, by the names that riis_valve_set knows. json_template makes a
// template for such a file from a valve.
#pragma once

#include <riis/riis.h>

#include <string>

#include "program/json.hpp"

namespace riis::program {

// Reads {"root_radius": 1.29, "right": {"leaflet_angle": 61}, "left.leaflet_angle": 58.5}. Names without a cusp are set first,
// so the order in the file does not matter. A repeated name is refused.
void set_from_json_file(riis_valve *valve, const std::string &path);

// Does the same from a JSON value. path, a file or a place in one, goes before refusals.
void set_from_json(riis_valve *valve, const Json &parameters, const std::string &path);

// Applies one --set.
void set_from_text(riis_valve *valve, const std::string &setting);

// Returns all parameters of the valve with their values.
std::string json_template(const riis_valve *valve);
// Returns the parameters as a table for people, with a line for each parameter: name, value, unit, range, description.
std::string parameter_table(const riis_valve *valve);

}  // namespace riis::program
