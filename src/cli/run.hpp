// SPDX-License-Identifier: Apache-2.0
// In: what the user asked for. Out: the files, and the report on stdout. The stages in order: surface, mesh, marks,
// files, pictures, report.
#pragma once

#include "cli/command_line.hpp"

namespace riis::cli {

// Throws a Refusal.
void run(const Options &options);

}  // namespace riis::cli
