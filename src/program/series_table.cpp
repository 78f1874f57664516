// SPDX-License-Identifier: Apache-2.0
#include "program/series_table.hpp"

#include <algorithm>
#include <limits>

#include "program/advice.hpp"
#include "program/numbers.hpp"
#include "program/report.hpp"

namespace riis::program {
namespace {

std::string from_to(const std::string &least, const std::string &most) {
  return least == most ? least : least + " to " + most;
}

}  // namespace

void SeriesTable::Range::add(double value) {
  least = std::min(least, value);
  most = std::max(most, value);
}

SeriesTable::SeriesTable(const Case &all) : text_("time") {
  constexpr double far = std::numeric_limits<double>::infinity();
  for (std::size_t valve = 0; valve < all.valves.size(); ++valve) {
    const std::string part = all.part_of(valve), prefix = part.empty() ? "" : part + "_";
    const Options &options = all.valves[valve].options;
    text_ += "," + prefix + "opening," + prefix + "n_marked," + prefix + "largest_speed";
    const std::string name = part.empty() ? (options.surface.empty() ? options.valve : options.surface) : part;
    rows_.push_back({name, {far, -far}, {far, -far}, {far, -far}});
  }
  text_ += ",seconds\n";
}

void SeriesTable::add(double time, const std::vector<MovingValve> &valves, double seconds) {
  text_ += shortest(time);
  for (std::size_t i = 0; i < valves.size(); ++i) {
    const double opening = valves[i].opening(), speed = valves[i].largest_speed();
    const int64_t n_marked = valves[i].stats().n_marked;
    text_ += "," + (valves[i].source().valve ? shortest(opening) : "") + "," + std::to_string(n_marked) + "," +
             shortest(speed);
    if (valves[i].source().valve) rows_[i].opening.add(opening);
    rows_[i].n_marked.add(static_cast<double>(n_marked));
    rows_[i].speed.add(speed);
  }
  text_ += "," + shortest(seconds) + "\n";
}

int64_t SeriesTable::most_marked() const {
  double most = 0;
  for (const Row &row : rows_) most = std::max(most, row.n_marked.most);
  return static_cast<int64_t>(most);
}

std::string SeriesTable::summary() const {
  std::string text;
  for (const Row &row : rows_) {
    // A surface from a file has none.
    const bool has_opening = row.opening.least <= row.opening.most;
    text +=
        "valve     " + row.name + ": " +
        (has_opening ? "opening " + from_to(shown(row.opening.least), shown(row.opening.most)) + ", " : "") +
        from_to(grouped(static_cast<int64_t>(row.n_marked.least)), grouped(static_cast<int64_t>(row.n_marked.most))) +
        " nodes marked, largest speed " + shown(row.speed.most) + "\n";
  }
  return text;
}

}  // namespace riis::program
