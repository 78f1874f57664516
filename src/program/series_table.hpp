// SPDX-License-Identifier: Apache-2.0
// The table of a series, a line for each time, as CSV.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "program/case.hpp"
#include "program/moving_valve.hpp"

namespace riis::program {

// time, opening, n_marked, largest_speed, seconds. Each of several valves has its own columns, NAME_opening and so on.
class SeriesTable {
 public:
  explicit SeriesTable(const Case &all);
  void add(double time, const std::vector<MovingValve> &valves, double seconds);
  const std::string &text() const { return text_; }
  // Returns the most marked nodes of all valves and times.
  int64_t most_marked() const;
  // Returns a line for each valve: its openings, marked nodes and speed.
  std::string summary() const;

 private:
  struct Range {
    double least, most;
    void add(double value);
  };
  struct Row {
    std::string name;
    Range opening, n_marked, speed;
  };
  std::string text_;
  std::vector<Row> rows_;
};

}  // namespace riis::program
