// SPDX-License-Identifier: Apache-2.0
// Text of users and files: numbers, times of a series, whole files, and text between the tags of XML.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace riis::program {

// In: words of the command line. Out: numbers, whatever the locale. Left-over characters are wrong usage, named by subject.

double parse_number(const std::string &text, const std::string &subject);
std::int32_t parse_integer(const std::string &text, const std::string &subject);
// Numbers between commas.
std::vector<double> parse_list(const std::string &text, const std::string &subject);
// The same with a fixed length. form shows the expected form, such as "X,Y,Z".
std::vector<double> parse_list(const std::string &text, const std::string &subject, std::size_t n,
                               const std::string &form);

// Returns the shortest text that stands for the number, in any locale.
std::string shortest(double number);

// In: a path. Out: the text of the file, or a refusal that names the file.

// Refuses the file. The reason may hold pieces of the file, of any length.
[[noreturn]] void refuse_file(const std::string &path, const std::string &reason);

// Refuses a file that cannot be read or is empty.
std::string text_of_file(const std::string &path);

// Text between the tags of XML, or in an attribute.

std::string in_xml(const std::string &text);

// In: the times of a series as a user writes them. Out: the times, ascending.

// The most that a series may have.
inline constexpr std::size_t most_times = 100000;

// START:STOP:STEP, with the stop, or times between commas. subject, such as "--times", begins refusals.
std::vector<double> parse_times(const std::string &text, const std::string &subject);

// Refuses times that do not ascend, fewer than two, and more than most_times.
void check_times(const std::vector<double> &times, const std::string &subject);

}  // namespace riis::program
