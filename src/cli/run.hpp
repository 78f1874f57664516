// SPDX-License-Identifier: Apache-2.0
// In: what the user asked for. Out: the files, and the report on stdout. The stages in order: surface, mesh, marks,
// files, pictures, report.
#pragma once

#include "cli/command_line.hpp"
#include "cli/refusal.hpp"

namespace riis::cli {

// exit_fine, or exit_none_marked where that was not to be expected. Throws a Refusal.
ExitCode run(const Options &options);

}  // namespace riis::cli
