// SPDX-License-Identifier: Apache-2.0
// The input is the file of a placed valve. The results are the valve's entries in OpenFOAM's dictionary of riisValve
// (examples/openfoam/README.md).
#pragma once

#include <optional>
#include <string>

#include "program/input/valve_file.hpp"

namespace riis::program {

// The longest skirt that OpenFOAM accepts by default, in metres. Gaps in patients are below 3 mm, and the walls of other chambers
// are farther away.
inline constexpr double longest_foam_skirt = 6e-3;

// Returns the entries valve, placement, warp and skirt. OpenFOAM's lengths are metres. `root` is the content of the file.
// `longest` is the length of the longest skirt in metres, or 0 for no skirt. The skirt ends at the patch `wall` of the mesh. A
// valve whose parameter skirt_length is set keeps its own skirt. If a kind of valve cannot have a skirt, there is no skirt.
// Refuses a warp that changes in time.
std::string foam_valve_of(const std::string &path, const Json &root, double longest);

}  // namespace riis::program
