// SPDX-License-Identifier: Apache-2.0
// Numbers in captions. In: numbers. Out: text for people.
#pragma once

#include <cstddef>
#include <string>

namespace riis::figures {

// 12345 as "12,345".
std::string count(std::size_t n);

// With so many significant digits at most: 0.050 as "0.05".
std::string number(double value, int digits = 3);

// 0.05 as "5 %".
std::string percent(double share);

}  // namespace riis::figures
