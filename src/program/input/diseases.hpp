// SPDX-License-Identifier: Apache-2.0
// The diseased valves that --valve accepts by the names of diagnoses. docs/diseases.md has the sources of their areas.
#pragma once

#include <string>

namespace riis::program {

struct Disease {
  const char *name, *kind;
  const char *parameters;  // a JSON object, as the file of --params
  int opening;             // 1: `area` is that of the open valve, 0: it is the gap of the closed valve
  double area;             // the orifice in cm2; 0: the disease changes no orifice that is seen along the axis
  const char *diagnosis;
};

// Returns the disease with that name, or nullptr.
const Disease *disease_named(const std::string &name);

// Returns a table of all diseases for the user to read.
std::string table_of_diseases();

}  // namespace riis::program
