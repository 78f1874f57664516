// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/text.hpp"

#include <algorithm>
#include <charconv>

namespace riis::vtk {

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char &c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower;
}

std::string_view take_line(std::string_view &text) {
  const std::size_t length = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  return line;
}

std::string_view take_word(std::string_view &text) {
  const auto begin = std::find_if_not(text.begin(), text.end(), is_blank);
  const auto end = std::find_if(begin, text.end(), is_blank);
  const std::string_view word =
      text.substr(static_cast<std::size_t>(begin - text.begin()), static_cast<std::size_t>(end - begin));
  text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
  return word;
}

std::string shortest(double number) {
  char text[32];
  const char *end = std::to_chars(text, text + sizeof text, number).ptr;
  return {text, static_cast<std::size_t>(end - text)};
}

}  // namespace riis::vtk
