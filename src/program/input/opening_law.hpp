// SPDX-License-Identifier: Apache-2.0
// The input is the user's description of a valve's motion. The result is the opening at any time, computed by the library's laws.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace riis::program {

// A table of openings at key times. If the period is 0, the table does not repeat.
struct OpeningTable {
  std::vector<double> times, openings;
  double period = 0;
  std::int32_t interpolation = RIIS_INTERPOLATION_LINEAR;
};

class OpeningLaw {
 public:
  // Makes a constant opening.
  explicit OpeningLaw(double opening) : law_(opening) {}
  // Messages of the library's refusals begin with `subject`, such as a file's name.
  OpeningLaw(OpeningTable table, const std::string &subject);
  OpeningLaw(const riis_opening_times &times, const std::string &subject);

  double at(double time) const;
  // Returns the derivative of the opening with respect to time.
  double rate_at(double time) const;
  bool is_constant() const { return std::holds_alternative<double>(law_); }

 private:
  // Evaluates the law once, so that the library refuses a bad law before the program does any other work.
  void rehearse() const;

  std::variant<double, OpeningTable, riis_opening_times> law_;
  std::string subject_;
};

// Returns the largest opening at these times. Without times, returns the opening of the law, which must be constant.
double largest_opening(const OpeningLaw &law, const std::vector<double> &times);

// Returns the names of the constants RIIS_INTERPOLATION_*. A name's position in the list is the value of its constant.
const std::vector<std::string> &interpolation_names();

// The input is a CSV file of times and values, and the result is the keys. Refusals name the file, the line and the value.

// Describes the second column of a file of keys.
struct KeyColumn {
  const char *name, *names;             // such as "opening" and "openings"
  std::function<bool(double)> is_good;  // whether a value is possible
  const char *fault;                    // the fault of another value, such as "is not from 0 to 1"
};

struct TimedValues {
  std::vector<double> times, values;
};

// The file has two columns, the time and the value. A comma, a semicolon, blanks or a tab separate the columns. The first line
// may name the columns. Empty lines and lines that begin with # are skipped. Times must ascend.
TimedValues read_keys(const std::string &path, const KeyColumn &column);

// Reads a table of openings. Each opening must be from 0 to 1.
OpeningTable read_cycle(const std::string &path, double period = 0,
                        std::int32_t interpolation = RIIS_INTERPOLATION_LINEAR);

}  // namespace riis::program
