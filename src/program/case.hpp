// SPDX-License-Identifier: Apache-2.0
// A case: one or several valves in one mesh, at one time or at many. A series of one valve from the command line is also a case.
#pragma once

#include <string>
#include <vector>

#include "program/options.hpp"
#include "program/refusal.hpp"
#include "program/valve_source.hpp"

namespace riis::program {

struct Case {
  MarkOptions options;  // the mesh, the times, the outputs, and a prefix for the arrays that all valves share
  std::vector<ValveSource> valves;
  std::vector<std::string> files;  // all files that were read; no output may replace one of them

  bool has_resistance() const;
  bool is_series() const { return !options.series.times.empty(); }
  // Returns the name for the files and columns of one valve, or "" if it is the only valve.
  std::string part_of(std::size_t valve) const { return valves.size() == 1 ? "" : valves[valve].options.prefix; }
};

// Returns the valve, the times and the cycle of the command line as a case.
Case case_of_command_line(const MarkOptions &options);

// Marks the mesh at one time. Returns exit_fine, or exit_none_marked if no node was marked and the user did not allow that.
// Throws a Refusal.
ExitCode run_case(Case &all);

}  // namespace riis::program
