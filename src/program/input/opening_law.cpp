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

// Checks a law. Reports a fault of the law as bad data, because all values of the law come from the user.
void check_law(riis_status status, const std::string &subject) {
  if (status == RIIS_INVALID_ARGUMENT) refuse_data(subject + ": " + riis_last_error());
  check(status, subject);
}

struct OpeningAndRate {
  double opening = 0, rate = 0;
};

OpeningAndRate at_time(double opening, double, const std::string &) { return {opening, 0}; }

OpeningAndRate at_time(const OpeningTable &table, double time, const std::string &subject) {
  auto keys = defaults<riis_opening_table>();
  keys.n_keys = view(table.times).size();
  keys.time = table.times.data();
  keys.opening = table.openings.data();
  keys.period = table.period;
  keys.interpolation = table.interpolation;
  OpeningAndRate made;
  check_law(riis_opening_from_table(&keys, time, &made.opening, &made.rate), subject);
  return made;
}

OpeningAndRate at_time(const riis_opening_times &times, double time, const std::string &subject) {
  OpeningAndRate made;
  check_law(riis_opening_from_times(&times, time, &made.opening, &made.rate), subject);
  return made;
}

}  // namespace

OpeningLaw::OpeningLaw(OpeningTable table, const std::string &subject) : law_(std::move(table)), subject_(subject) {
  rehearse();
}

OpeningLaw::OpeningLaw(const riis_opening_times &times, const std::string &subject) : law_(times), subject_(subject) {
  rehearse();
}

double OpeningLaw::at(double time) const {
  return std::visit([&](const auto &law) { return at_time(law, time, subject_).opening; }, law_);
}

double OpeningLaw::rate_at(double time) const {
  return std::visit([&](const auto &law) { return at_time(law, time, subject_).rate; }, law_);
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

// The limits are those of the library's tables of openings.
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

TimedValues read_keys(const std::string &path, const KeyColumn &column) {
  TimedValues keys;
  std::size_t line_number = 0;
  const std::string name = column.name;
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
      refuse("has " + std::to_string(columns.size()) + " columns: '" + line + "'; it must have 2, time and " + name);
    if (may_be_header && !number_in(columns[0]) && !number_in(columns[1])) continue;
    const double time = number(columns[0], "the time"), value = number(columns[1], "the " + name);
    if (keys.times.size() == most_keys) refuse("is one key more than allowed; a file may have at most 1000000 keys");
    if (std::abs(time) > largest_key_time) refuse("the time " + columns[0] + " is beyond 1e30");
    if (!keys.times.empty() && time <= keys.times.back())
      refuse("the time " + columns[0] + " is not above the time before it");
    if (!column.is_good(value)) refuse("the " + name + " " + columns[1] + " " + column.fault);
    keys.times.push_back(time);
    keys.values.push_back(value);
  }
  if (keys.times.empty()) refuse_file(path, std::string("holds no times and ") + column.names);
  return keys;
}

OpeningTable read_cycle(const std::string &path, double period, std::int32_t interpolation) {
  const auto is_good = [](double opening) { return opening >= 0 && opening <= 1; };
  TimedValues keys = read_keys(path, {"opening", "openings", is_good, "is not from 0 to 1"});
  return {std::move(keys.times), std::move(keys.values), period, interpolation};
}

}  // namespace riis::program
