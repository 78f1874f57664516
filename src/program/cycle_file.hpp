// SPDX-License-Identifier: Apache-2.0
// In: a CSV file of times and openings. Out: the keys. Refusals name the file, the line and the value.
#pragma once

#include <string>

#include "program/opening_law.hpp"

namespace riis::program {

// Two columns, time and opening, separated by a comma, a semicolon, blanks or a tab. The first line may name them. Empty lines
// and lines that begin with # are left out. Times must ascend, openings lie from 0 to 1.
OpeningTable read_cycle(const std::string &path);

}  // namespace riis::program
