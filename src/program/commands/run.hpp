// SPDX-License-Identifier: Apache-2.0
// In: the user's request. Out: the files, and the report on stdout. The stages of marking at one time are, in this order:
// surface, mesh, marks, files, pictures, report. series.hpp and case.hpp describe the stages of series and cases.
#pragma once

#include "program/base/refusal.hpp"
#include "program/cli/command_line.hpp"

namespace riis::program {

// Returns exit_fine, or exit_none_marked if no node was marked and the user did not allow that. With --strict, may return
// exit_warned. Throws a Refusal.
ExitCode run(const Request &request);

}  // namespace riis::program
