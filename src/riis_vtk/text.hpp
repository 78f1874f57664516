// SPDX-License-Identifier: Apache-2.0
// Lines and words of the files that are scanned before VTK sees them. Only ASCII counts, whatever the locale.
#pragma once

#include <string>
#include <string_view>

namespace riis::vtk {

bool is_blank(char c);

std::string lower_case(std::string_view text);

// Removes the first line from the text and returns it without its line feed.
std::string_view take_line(std::string_view &text);

// Removes the first word and the blanks before it. Returns the word, or "" if there is none.
std::string_view take_word(std::string_view &text);

// The shortest text that stands for the number, such as "nan" and "0.1".
std::string shortest(double number);

}  // namespace riis::vtk
