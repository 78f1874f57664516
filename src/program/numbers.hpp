// SPDX-License-Identifier: Apache-2.0
// In: words of the command line. Out: numbers, whatever the locale. Left-over characters are wrong usage, named by subject.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace riis::program {

double parse_number(const std::string &text, const std::string &subject);
std::int32_t parse_integer(const std::string &text, const std::string &subject);
// Numbers between commas.
std::vector<double> parse_list(const std::string &text, const std::string &subject);
// The same with a fixed length. form shows the expected form, such as "X,Y,Z".
std::vector<double> parse_list(const std::string &text, const std::string &subject, std::size_t n,
                               const std::string &form);

// Returns the shortest text that stands for the number, in any locale.
std::string shortest(double number);

}  // namespace riis::program
