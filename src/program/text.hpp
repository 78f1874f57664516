// SPDX-License-Identifier: Apache-2.0
// Reads and writes text: numbers, times of a series, whole files, and text between the tags of XML.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace riis::program {

// In: words of the command line. Out: numbers, in any locale. Further characters are wrong usage. subject names the value in
// the refusal.

double parse_number(const std::string &text, const std::string &subject);
std::int32_t parse_integer(const std::string &text, const std::string &subject);
// Reads numbers that are separated by commas.
std::vector<double> parse_list(const std::string &text, const std::string &subject);
// Reads a fixed number of such numbers. form shows the expected form, such as "X,Y,Z".
std::vector<double> parse_list(const std::string &text, const std::string &subject, std::size_t n,
                               const std::string &form);

// Returns the shortest text that stands for the number, in any locale.
std::string shortest(double number);

// In: a path. Out: the text of the file, or a refusal that names the file.

// Refuses the file. The reason may contain pieces of the file, of any length.
[[noreturn]] void refuse_file(const std::string &path, const std::string &reason);

// Refuses a file that cannot be read or is empty.
std::string text_of_file(const std::string &path);

// Makes text fit for the space between the tags of XML, or for an attribute.

std::string in_xml(const std::string &text);

// In: the times of a series as a user writes them. Out: the times, ascending.

// The largest number of times of a series.
inline constexpr std::size_t most_times = 100000;

// Reads START:STOP:STEP, which includes STOP, or times that are separated by commas. subject, such as "--times", begins
// refusals.
std::vector<double> parse_times(const std::string &text, const std::string &subject);

// Refuses times that do not ascend, fewer than two times, and more than most_times.
void check_times(const std::vector<double> &times, const std::string &subject);

}  // namespace riis::program
