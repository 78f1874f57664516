// SPDX-License-Identifier: Apache-2.0
// Compares the reader of numbers for macOS with this system's std::from_chars. Both readers must give equal results for texts of
// numbers and for broken texts.
#include <charconv>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "common/number_from_chars.hpp"
#include "test_support.h"

namespace {

int n_numbers = 0, n_refused = 0, n_out_of_range = 0;

bool is_read_alike(const std::string &text) {
  double ours = 7, theirs = 7;
  const char *const first = text.data(), *const last = first + text.size();
  const std::from_chars_result own = riis::double_from_chars(first, last, ours),
                               other = std::from_chars(first, last, theirs);
  n_numbers += other.ec == std::errc();
  n_refused += other.ec == std::errc::invalid_argument;
  n_out_of_range += other.ec == std::errc::result_out_of_range;
  if (own.ptr == other.ptr && own.ec == other.ec && std::memcmp(&ours, &theirs, sizeof ours) == 0) return true;
  std::printf("'%s': %td characters, %g, %d; std::from_chars: %td, %g, %d\n", text.c_str(), own.ptr - first, ours,
              static_cast<int>(own.ec), other.ptr - first, theirs, static_cast<int>(other.ec));
  return false;
}

std::string random_text(random_source *random) {
  // The parts of a number, in their order. A broken text has any parts in any order.
  static const std::vector<std::vector<std::string>> parts = {
      {"", "-", "+", " "},
      {"", "0", "7", "00120", "3141592653589793238462643", "0x1p3"},
      {"", ".", ",", ".."},
      {"", "5", "000", "00000000000000000000000000012", "9999999999999999"},
      {"", "e", "E", "e+", "e-", "p"},
      {"", "0", "12", "300", "308", "323", "324", "400", "99999999999"},
      {"", " ", "x", "\n", "inf", "INFINITY", "infinit", "nan", "nan(1_a)", "nan(-)"}};
  const bool is_broken = random_bits(random) % 4 == 0;
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto &choices = parts[is_broken ? random_bits(random) % parts.size() : i];
    text += choices[random_bits(random) % choices.size()];
  }
  return text;
}

}  // namespace

int main() {
  random_source random = random_start("test_number_from_chars");
  int n_faults = 0;
  for (int i = 0; i < 200000; ++i) n_faults += !is_read_alike(random_text(&random));
  for (int i = 0; i < 100000; ++i) {  // any double, and its text with too few or too many digits
    const std::uint64_t bits = random_bits(&random);
    double number = 0;
    std::memcpy(&number, &bits, sizeof number);
    char text[64];
    std::snprintf(text, sizeof text, "%.*e", static_cast<int>(bits % 20), number);
    n_faults += !is_read_alike(text);
  }
  for (const char *text : {"", "-", ".", "e5", "1e", "1e+", "4.9e-324", "2.4e-324", "2.5e-324",
                           "1.7976931348623159e308", "nan", "-nan", "-inf"})
    n_faults += !is_read_alike(text);
  std::printf("%d numbers, %d refused, %d out of range\n", n_numbers, n_refused, n_out_of_range);
  if (n_numbers < 50000 || n_refused < 10000 || n_out_of_range < 1000) ++n_faults;
  return n_faults == 0 ? 0 : 1;
}
