// SPDX-License-Identifier: Apache-2.0
// In: a case file in JSON, which describes the valves of a mesh with their placements and motions. Out: the case. Paths in the
// file are relative to the file's folder. Refusals name the file, the valve and the key.
#pragma once

#include <functional>
#include <string>

#include "program/input/case.hpp"
#include "program/input/json.hpp"
#include "program/input/opening_law.hpp"

namespace riis::program {

// Reads the case file of --case. A mesh, times, a distance limit, a resistance and the points of --between on the command line
// replace those in the file.
Case read_case(const MarkOptions &options);

// In: the opening of a valve in a case. Out: its law.

struct CaseOpening {
  OpeningLaw law;
  std::string file;  // the file that was read, or "" if there was none
};

// Reads a number or an object. An object is {"file"} or {"times", "openings"}, each with "period" and "interpolation", or it is
// {"opening_start", "opening_duration", "closing_start", "closing_duration", "closed", "open", "period"}. in_folder turns a path
// of the case file into a path relative to the working folder.
CaseOpening case_opening(const CaseValues &valve, const std::function<std::string(const std::string &)> &in_folder);

}  // namespace riis::program
