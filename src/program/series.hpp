// SPDX-License-Identifier: Apache-2.0
// A series in time: the mesh is read once, and the nodes near the valves' sweep are found in a first pass over the times. A
// second pass marks and writes.
#pragma once

#include "program/case.hpp"
#include "program/refusal.hpp"

namespace riis::program {

// Returns exit_fine, or exit_none_marked if no node is marked at any time and the user did not allow that. Throws a Refusal.
ExitCode run_series(Case &all);

}  // namespace riis::program
