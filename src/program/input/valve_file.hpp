// SPDX-License-Identifier: Apache-2.0
// In: a JSON file of boundary curves and patches. Out: a valve, with an open state if the file has one.
#pragma once

#include <riis/riis.h>
#include <optional>
#include <string>

#include "program/base/handles.hpp"
#include "program/base/options.hpp"
#include "program/input/json.hpp"

namespace riis::program {

// Returns whether --valve is a file, which ends in .json, and not a kind.
bool is_valve_file(const std::string &valve);

// {"curves": {"edge": [[0, 0, 0], [1, 0, 0]], ...},
//  "patches": [{"v0": "edge", "v1": "-rim", "u0": ..., "u1": ..., "leaflet": 0}, ...],
//  "open": {"curves": {"edge": ...}}}
// A curve with 2, 3 or 4 points has them as control points of degree 1, 2 or 3. A curve with 1 point is a side that is collapsed
// to it. A minus reverses the curve. "leaflet" (0 by default) and "open" may be left out. Refusals name the curve, or the
// patch by its number from 0.
struct ValveFile {
  explicit ValveFile(const std::string &path);

  Valve valve;
  bool can_open = false;  // whether the file has an open state
};

// A placed valve: a JSON file of riis place, with the kind, the parameters and the placement of a patient's valve. Every command
// takes this file as --valve FILE.json, and Python's read_placed reads it.
struct PlacedFile {
  std::string kind;
  Unit unit = Unit::centimetre, own_unit = Unit::centimetre;      // of the placement, and of the file
  double factor = 1;                                              // from the file's unit to this one
  riis_surface_options where = defaults<riis_surface_options>();  // the placement
  Json parameters, warp;                                          // null: the valve has no warp
};
// `root` is the content of the file. Without `unit`, the placement keeps the unit of the file.
PlacedFile read_placed(const std::string &path, const Json &root, std::optional<Unit> unit = std::nullopt);

// If --valve is a disease or the file of a placed valve, replaces it by the kind. The file's placement replaces the options for
// the placement, and options that the file already contains are refused. set_own_parameters sets the parameters of the disease
// or of the file. Leaves other valves as they are.
void use_named_valve(ValveOptions &options);
void set_own_parameters(const ValveOptions &options, riis_valve *valve);

}  // namespace riis::program
