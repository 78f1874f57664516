// SPDX-License-Identifier: Apache-2.0
#include "program/case_opening.hpp"

#include <utility>

#include "program/cycle_file.hpp"
#include "program/refusal.hpp"

namespace riis::program {
namespace {

const std::vector<std::string> table_keys = {"times", "openings", "period", "interpolation"};
const std::vector<std::string> cycle_keys = {"file", "period", "interpolation"};
const std::vector<std::string> ramp_keys = {
    "opening_start", "opening_duration", "closing_start", "closing_duration", "closed", "open", "period"};

OpeningLaw law_of_table(const CaseValues &values, OpeningTable table, const std::string &subject) {
  table.period = values.above_zero("period").value_or(0);
  table.interpolation = static_cast<std::int32_t>(values.choice("interpolation", interpolation_names()));
  return OpeningLaw(std::move(table), subject);
}

OpeningLaw law_of_arrays(const CaseValues &values) {
  const OpeningTable table{values.numbers("times"), values.numbers("openings")};
  if (table.times.size() != table.openings.size()) {
    values.refuse("openings", "there are " + std::to_string(table.openings.size()) + " for " +
                                  std::to_string(table.times.size()) + " times");
  }
  return law_of_table(values, table, values.subject());
}

OpeningLaw law_of_ramps(const CaseValues &values) {
  riis_opening_times times;
  check(riis_opening_times_init(&times, sizeof times));
  const auto set = [&](const char *key, double &field) {
    if (const auto number = values.number(key)) field = *number;
  };
  for (const char *key : {"opening_start", "opening_duration", "closing_start", "closing_duration"})
    static_cast<void>(values.needed(key));
  set("opening_start", times.opening_start);
  set("opening_duration", times.opening_duration);
  set("closing_start", times.closing_start);
  set("closing_duration", times.closing_duration);
  set("closed", times.closed);
  set("open", times.open);
  times.period = values.above_zero("period").value_or(0);
  return OpeningLaw(times, values.subject());
}

}  // namespace

CaseOpening case_opening(const CaseValues &valve, const std::function<std::string(const std::string &)> &in_folder) {
  const Json &value = valve.needed("opening");
  if (value.is_number()) {
    const double opening = value.get<double>();
    if (!(opening >= 0 && opening <= 1)) valve.refuse("opening", value.dump() + " is not from 0 to 1");
    return {OpeningLaw(opening), ""};
  }
  const std::string object = valve.subject().substr(valve.path().size() + 2) + ": opening";
  if (!value.is_object()) valve.refuse("opening", value.dump() + " is neither a number nor an object");
  if (value.contains("file")) {
    const CaseValues values(valve.path(), object, value, cycle_keys);
    const std::string file = in_folder(values.text("file"));
    return {law_of_table(values, read_cycle(file), file), file};
  }
  if (value.contains("times")) return {law_of_arrays({valve.path(), object, value, table_keys}), ""};
  if (value.contains("opening_start")) return {law_of_ramps({valve.path(), object, value, ramp_keys}), ""};
  valve.refuse("opening", "it has none of file, times and opening_start");
}

}  // namespace riis::program
