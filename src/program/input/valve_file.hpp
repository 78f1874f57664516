// SPDX-License-Identifier: Apache-2.0
// What --valve names: a file of patches, a placed valve, or a disease.
#pragma once

#include <riis/riis.h>
#include <optional>
#include <string>

#include "program/base/handles.hpp"
#include "program/base/options.hpp"
#include "program/input/json.hpp"

namespace riis::program {

// Returns whether --valve names a file, not a kind. Files of valves end in .json.
bool is_valve_file(const std::string &valve);

// The input is a JSON file of boundary curves and patches. The result is a valve, which has an open state if the file has one.
//
// {"curves": {"edge": [[0, 0, 0], [1, 0, 0]], ...},
//  "patches": [{"v0": "edge", "v1": "-rim", "u0": ..., "u1": ..., "leaflet": 0}, ...],
//  "open": {"curves": {"edge": ...}}}
// A curve with 2, 3 or 4 points is a Bezier curve of degree 1, 2 or 3, and the points are its control points. A curve with 1
// point is a side of a patch that collapses to this point. A minus before the name of a curve reverses the curve. The keys
// "leaflet" and "open" may be missing; the default leaflet is 0. Refusals name the curve, or the number of the patch, counted
// from 0.
struct ValveFile {
  explicit ValveFile(const std::string &path);

  Valve valve;
  bool can_open = false;  // whether the file has an open state
};

// A placed valve: a JSON file of riis place, with the kind, the parameters and the placement of a patient's valve. Every command
// takes a placed valve by --valve FILE.json, and Python reads it by read_placed.
struct PlacedFile {
  std::string kind;
  Unit unit = Unit::centimetre, own_unit = Unit::centimetre;      // of the placement, and of the file
  double factor = 1;                                              // from the file's unit to the placement's
  riis_surface_options where = defaults<riis_surface_options>();  // the placement
  Json parameters, warp;                                          // null: the valve has no warp
};
// `root` is the content of the file. Without `unit`, the placement stays in the unit of the file.
PlacedFile read_placed(const std::string &path, const Json &root, std::optional<Unit> unit = std::nullopt);

// The diseased valves that --valve accepts by the names of diagnoses. docs/diseases.md has the sources of their areas.
struct Disease {
  const char *name, *kind;
  const char *parameters;  // a JSON object, as the file of --params
  int opening;             // 1: `area` is that of the open valve, 0: it is the gap of the closed valve
  double area;             // the orifice in cm2; 0: the disease does not change the orifice as seen along the axis
  const char *diagnosis;
};

// Returns the disease with the given name, or nullptr if there is none.
const Disease *disease_named(const std::string &name);

// Returns a table of all diseases for the user to read.
std::string table_of_diseases();

// If --valve is a disease or the file of a placed valve, replaces it by the valve's kind. The file's placement becomes the
// placement of the options. An option is refused if the file already gives its value. set_own_parameters sets the parameters of
// the disease or of the file. Other valves are left unchanged.
void use_named_valve(ValveOptions &options);
void set_own_parameters(const ValveOptions &options, riis_valve *valve);

}  // namespace riis::program
