// SPDX-License-Identifier: Apache-2.0
// A placed valve: a JSON file of riis place, with the kind, the parameters and the placement of a patient's valve. Every command
// takes it as --valve FILE.json, and Python's read_placed reads it.
#pragma once

#include <riis/riis.h>

#include <optional>
#include <string>

#include "program/base/options.hpp"
#include "program/input/json.hpp"

namespace riis::program {

struct PlacedFile {
  std::string kind;
  Unit unit = Unit::centimetre;  // of the placement
  double factor = 1;             // from the file's unit to this one
  riis_surface_options where;    // the placement
  Json parameters, warp;         // null: the valve has no warp
};
// `root` is the content of the file. Without a unit, the placement has the file's.
PlacedFile read_placed(const std::string &path, const Json &root, std::optional<Unit> unit = std::nullopt);

// If --valve is the file of a placed valve, replaces the options for kind and placement by those of the file.
// set_placed_parameters sets the file's parameters. Refuses options that the file already contains. Leaves other valves as they
// are.
void use_placed_valve(ValveOptions &options);
void set_placed_parameters(const ValveOptions &options, riis_valve *valve);

}  // namespace riis::program
