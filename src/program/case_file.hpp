// SPDX-License-Identifier: Apache-2.0
// In: a case file, the valves of a mesh with their placements and motions, in JSON. Out: the case. Paths in the file are relative
// to it. Refusals name the file, the valve and the key.
#pragma once

#include "program/case.hpp"

namespace riis::program {

// Reads the case of --case. A mesh, times and distance limit on the command line take the place of the file's.
Case read_case(const Options &options);

}  // namespace riis::program
