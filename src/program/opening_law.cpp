// SPDX-License-Identifier: Apache-2.0
#include "program/opening_law.hpp"

#include <algorithm>
#include <utility>

#include "common/array_view.hpp"
#include "program/refusal.hpp"

namespace riis::program {
namespace {

// Refuses a law as bad data: its values are the user's, also if they are out of range.
void check_law(riis_status status, const std::string &subject) {
  if (status == RIIS_INVALID_ARGUMENT) throw Refusal{exit_bad_data, subject + ": " + riis_last_error()};
  check(status, subject);
}

double opening_from(double opening, double, const std::string &) { return opening; }

double opening_from(const OpeningTable &table, double time, const std::string &subject) {
  riis_opening_table keys;
  check(riis_opening_table_init(&keys, sizeof keys));
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

}  // namespace riis::program
