// SPDX-License-Identifier: Apache-2.0
// In: the user's description of a valve's motion. Out: the opening at any time, by the library's laws.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace riis::program {

// A table of keys in time. A period of 0 stands for none.
struct OpeningTable {
  std::vector<double> times, openings;
  double period = 0;
  std::int32_t interpolation = RIIS_INTERPOLATION_LINEAR;
};

class OpeningLaw {
 public:
  // The opening is constant.
  explicit OpeningLaw(double opening) : law_(opening) {}
  // subject, such as a file's name, goes before the library's refusals of a law.
  OpeningLaw(OpeningTable table, const std::string &subject);
  OpeningLaw(const riis_opening_times &times, const std::string &subject);

  double at(double time) const;
  bool is_constant() const { return std::holds_alternative<double>(law_); }

 private:
  // Evaluates the law once, so that the library refuses a bad law before any other work.
  void rehearse() const;

  std::variant<double, OpeningTable, riis_opening_times> law_;
  std::string subject_;
};

// Returns the largest opening at these times. Without times the law must be constant, and its opening is returned.
double largest_opening(const OpeningLaw &law, const std::vector<double> &times);

// Returns the names of RIIS_INTERPOLATION_*, each at its position.
const std::vector<std::string> &interpolation_names();

// In: a CSV file of times and openings. Out: the keys. Refusals name the file, the line and the value.

// Two columns, time and opening, separated by a comma, a semicolon, blanks or a tab. The first line may name them. Empty lines
// and lines that begin with # are left out. Times must ascend, openings lie from 0 to 1.
OpeningTable read_cycle(const std::string &path);

}  // namespace riis::program
