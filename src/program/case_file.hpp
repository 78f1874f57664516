// SPDX-License-Identifier: Apache-2.0
// In: a case file in JSON, which describes the valves of a mesh with their placements and motions. Out: the case. Paths in the
// file are relative to it. Refusals name the file, the valve and the key.
#pragma once

#include <functional>
#include <string>

#include "program/case.hpp"
#include "program/json.hpp"
#include "program/opening_law.hpp"

namespace riis::program {

// Reads the case of --case. A mesh, times and distance limit on the command line take the place of the file's.
Case read_case(const MarkOptions &options);

// In: the opening of a valve in a case. Out: its law.

struct CaseOpening {
  OpeningLaw law;
  std::string file;  // the file that was read; "": none
};

// Reads a number, or an object: {"file"}, {"times", "openings"}, each with "period" and "interpolation", or {"opening_start",
// "opening_duration", "closing_start", "closing_duration", "closed", "open", "period"}. in_folder makes a path relative to the
// case.
CaseOpening case_opening(const CaseValues &valve, const std::function<std::string(const std::string &)> &in_folder);

}  // namespace riis::program
