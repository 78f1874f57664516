// SPDX-License-Identifier: Apache-2.0
#include "program/numbers.hpp"

#include <charconv>

#include "program/refusal.hpp"

namespace riis::program {
namespace {

template <class Number>
Number parse(const std::string &text, const std::string &subject, const char *kind) {
  // from_chars knows no plus sign.
  const char *first = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  const char *last = text.data() + text.size();
  Number number{};
  const auto [end, error] = std::from_chars(first, last, number);
  if (error != std::errc() || end != last) {
    throw Refusal{exit_wrong_usage, subject + ": '" + text + "' is not " + kind};
  }
  return number;
}

}  // namespace

double parse_number(const std::string &text, const std::string &subject) {
  return parse<double>(text, subject, "a number that fits a double");
}

std::int32_t parse_integer(const std::string &text, const std::string &subject) {
  return parse<std::int32_t>(text, subject, "a whole number of 32 bits");
}

std::vector<double> parse_list(const std::string &text, const std::string &subject) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    numbers.push_back(parse_number(text.substr(begin, end - begin), subject));
    begin = end + 1;
  }
  return numbers;
}

std::vector<double> parse_list(const std::string &text, const std::string &subject, std::size_t n,
                               const std::string &form) {
  std::vector<double> numbers = parse_list(text, subject);
  if (numbers.size() != n) {
    throw Refusal{exit_wrong_usage,
                  subject + ": '" + text + "' has " + std::to_string(numbers.size()) + " numbers; it takes " + form};
  }
  return numbers;
}

std::string shortest(double number) {
  char text[32];
  const char *end = std::to_chars(text, text + sizeof text, number).ptr;
  return {text, static_cast<std::size_t>(end - text)};
}

}  // namespace riis::program
