// SPDX-License-Identifier: Apache-2.0
// In: sizes that do not fit each other. Out: what they look like, and the options that would make them fit.
#pragma once

#include <optional>
#include <string>

#include "program/warnings.hpp"

namespace riis::program {

// These tell whether the half thickness is larger than a quarter of the surface, or so small that it falls between the mesh's
// nodes.
bool is_too_large(double half_thickness, const Situation &situation);
bool is_too_small(double half_thickness, const Situation &situation);

// Says which units the sizes of a mesh and a surface look like, if these differ, and what to write, such as "the mesh looks as if
// it were in metres, ...: write --unit m".
std::optional<Warning> warning_of_units(const Situation &situation);

// Says whether the half thickness is too large or too small, and what to write.
std::optional<Warning> warning_of_half_thickness(const Situation &situation);

// Returns a number as a user would write it.
std::string shown(double number);

}  // namespace riis::program
