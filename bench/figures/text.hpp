// SPDX-License-Identifier: Apache-2.0
// Formats numbers for captions.
#pragma once

#include <cstddef>
#include <string>

namespace riis::figures {

// Returns 12345 as "12,345".
std::string count(std::size_t n);

// Returns the number with at most this many significant digits: 0.050 becomes "0.05".
std::string number(double value, int digits = 3);

// Returns 0.05 as "5 %".
std::string percent(double share);

}  // namespace riis::figures
