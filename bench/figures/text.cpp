// SPDX-License-Identifier: Apache-2.0
#include "figures/text.hpp"

#include <cstdio>

namespace riis::figures {

std::string count(std::size_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t i = digits.size(); i > 3;) digits.insert(i -= 3, ",");
  return digits;
}

std::string number(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string percent(double share) { return number(100 * share) + " %"; }

}  // namespace riis::figures
