// SPDX-License-Identifier: Apache-2.0
// In: the opening of a valve in a case. Out: its law.
#pragma once

#include <functional>
#include <string>

#include "program/case_values.hpp"
#include "program/opening_law.hpp"

namespace riis::program {

struct CaseOpening {
  OpeningLaw law;
  std::string file;  // that was read; "": none
};

// A number, or an object: {"file"}, {"times", "openings"}, each with "period" and "interpolation", or {"opening_start",
// "opening_duration", "closing_start", "closing_duration", "closed", "open", "period"}. in_folder makes a path relative to the
// case.
CaseOpening case_opening(const CaseValues &valve, const std::function<std::string(const std::string &)> &in_folder);

}  // namespace riis::program
