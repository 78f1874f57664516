// SPDX-License-Identifier: Apache-2.0
#include "program/input/opening_law.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include <riis/riis.hpp>

#include "common/array_view.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"

namespace riis::program {

namespace {

// Checks a law. Reports its faults as bad data, because all its values come from the user.
void check_law(riis_status status, const std::string &subject) {
  if (status == RIIS_INVALID_ARGUMENT) refuse_data(subject + ": " + riis_last_error());
  check(status, subject);
}

double opening_from(double opening, double, const std::string &) { return opening; }

double opening_from(const OpeningTable &table, double time, const std::string &subject) {
  auto keys = defaults<riis_opening_table>();
  keys.n_keys = view(table.times).size();
  keys.time = table.times.data();
  keys.opening = table.openings.data();
  keys.period = table.period;
  keys.interpolation = table.interpolation;
  double opening = 0;
  check_law(riis_opening_from_table(&keys, time, &opening, nullptr), subject);
  return opening;
}

double opening_from(const riis_opening_times &times, double time, const std::string &subject) {
  double opening = 0;
  check_law(riis_opening_from_times(&times, time, &opening, nullptr), subject);
  return opening;
}

}  // namespace

OpeningLaw::OpeningLaw(OpeningTable table, const std::string &subject) : law_(std::move(table)), subject_(subject) {
  rehearse();
}

OpeningLaw::OpeningLaw(const riis_opening_times &times, const std::string &subject) : law_(times), subject_(subject) {
  rehearse();
}

double OpeningLaw::at(double time) const {
  return std::visit([&](const auto &law) { return opening_from(law, time, subject_); }, law_);
}

void OpeningLaw::rehearse() const { static_cast<void>(at(0)); }

double largest_opening(const OpeningLaw &law, const std::vector<double> &times) {
  double largest = times.empty() ? law.at(0) : 0;
  for (const double time : times) largest = std::max(largest, law.at(time));
  return largest;
}

const std::vector<std::string> &interpolation_names() {
  static const std::vector<std::string> names = {"linear", "cubic"};
  return names;
}

// ---- Cycle file ----

namespace {

// The library has the same limits for a table.
constexpr std::size_t most_keys = 1000000;
constexpr double largest_key_time = 1e30;

std::vector<std::string> columns_of(std::string line) {
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == ',' || c == ';' || c == '\t' || c == '\r'; }, ' ');
  std::istringstream words(line);
  std::vector<std::string> columns;
  for (std::string word; words >> word;) columns.push_back(word);
  return columns;
}

}  // namespace

OpeningTable read_cycle(const std::string &path, double period, std::int32_t interpolation) {
  OpeningTable keys{{}, {}, period, interpolation};
  std::size_t line_number = 0;
  const auto refuse = [&](const std::string &reason) {
    refuse_file(path, "line " + std::to_string(line_number) + ": " + reason);
  };
  const auto number = [&](const std::string &text, const std::string &what) {
    const auto found = number_in(text);
    if (!found || !std::isfinite(*found)) refuse(what + " '" + text + "' is not a finite number");
    return *found;
  };
  bool is_first = true;
  for (const std::string &line : split(text_of_file(path), "\n")) {
    ++line_number;
    const std::vector<std::string> columns = columns_of(line);
    if (columns.empty() || columns[0][0] == '#') continue;
    const bool may_be_header = std::exchange(is_first, false);
    if (columns.size() != 2)
      refuse("has " + std::to_string(columns.size()) + " columns: '" + line + "'; it must have 2, time and opening");
    if (may_be_header && !number_in(columns[0]) && !number_in(columns[1])) continue;
    const double time = number(columns[0], "the time"), opening = number(columns[1], "the opening");
    if (keys.times.size() == most_keys) refuse("is one key too many; there may be 1000000");
    if (std::abs(time) > largest_key_time) refuse("the time " + columns[0] + " is beyond 1e30");
    if (!keys.times.empty() && time <= keys.times.back())
      refuse("the time " + columns[0] + " is not above the time before it");
    if (!(opening >= 0 && opening <= 1)) refuse("the opening " + columns[1] + " is not from 0 to 1");
    keys.times.push_back(time);
    keys.openings.push_back(opening);
  }
  if (keys.times.empty()) refuse_file(path, "holds no times and openings");
  return keys;
}

}  // namespace riis::program
