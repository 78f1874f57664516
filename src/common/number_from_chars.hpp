// SPDX-License-Identifier: Apache-2.0
// Reads a number as std::from_chars does. The standard library of macOS, libc++, has that function for integers only.
#pragma once

#include <locale.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <system_error>
#include <type_traits>
#if defined(__APPLE__)
#include <xlocale.h>
#endif

namespace riis {

// Finds the text of a number. Each function moves `at` to the end of the item that it finds, and returns whether it has found the
// item.
class NumberText {
 public:
  NumberText(const char *first, const char *last) : at(first), last_(last) {}

  // Finds digits, with or without a point and an exponent.
  bool has_digits() {
    const char *next = behind_digits(at);
    std::ptrdiff_t n_digits = next - at;
    if (next != last_ && *next == '.') {
      const char *const end = behind_digits(next + 1);
      n_digits += end - (next + 1);
      next = end;
    }
    if (n_digits == 0) return false;
    at = next;
    if (next == last_ || (*next | 0x20) != 'e') return true;
    ++next;
    if (next != last_ && (*next == '+' || *next == '-')) ++next;
    if (const char *const end = behind_digits(next); end != next) at = end;
    return true;
  }
  // Finds "inf", "infinity", "nan" or "nan(...)", in capital or small letters.
  bool is_no_number() {
    if (has("inf")) {
      has("inity");
      return true;
    }
    if (!has("nan")) return false;
    const char *end = at;
    if (end == last_ || *end != '(') return true;
    for (++end; end != last_ && (std::isalnum(static_cast<unsigned char>(*end)) != 0 || *end == '_');) ++end;
    if (end != last_ && *end == ')') at = end + 1;
    return true;
  }

  const char *at;

 private:
  const char *behind_digits(const char *from) const {
    while (from != last_ && *from >= '0' && *from <= '9') ++from;
    return from;
  }
  bool has(const char *word) {
    const char *next = at;
    for (; *word != '\0'; ++word, ++next)
      if (next == last_ || (*next | 0x20) != *word) return false;
    at = next;
    return true;
  }

  const char *last_;
};

// Reads a double by strtod, with the same result as std::from_chars. strtod gets only the text of the number, because it would
// also accept blanks, a plus sign, and hexadecimal digits.
inline std::from_chars_result double_from_chars(const char *first, const char *last, double &number) {
  NumberText text(first != last && *first == '-' ? first + 1 : first, last);
  const bool has_digits = text.has_digits();
  if (!has_digits && !text.is_no_number()) return {first, std::errc::invalid_argument};
  static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
  const std::string copy(first, text.at);
  const double value = strtod_l(copy.c_str(), nullptr, c_locale);
  const bool is_too_small = value == 0 && copy.find_first_of("123456789") < copy.find_first_of("eE");
  if (has_digits && (std::isinf(value) || is_too_small)) return {text.at, std::errc::result_out_of_range};
  number = value;
  return {text.at, std::errc()};
}

template <class Number>
std::from_chars_result number_from_chars(const char *first, const char *last, Number &number) {
#if !defined(__cpp_lib_to_chars)
  if constexpr (std::is_same_v<Number, double>)
    return double_from_chars(first, last, number);
  else
#endif
    return std::from_chars(first, last, number);
}

}  // namespace riis
