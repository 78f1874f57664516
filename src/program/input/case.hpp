// SPDX-License-Identifier: Apache-2.0
// A case: one or several valves in one mesh, at one time or at many. The valve of the command line is a case of one.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "program/base/options.hpp"
#include "program/input/json.hpp"
#include "program/input/opening_law.hpp"
#include "program/input/valve_source.hpp"
#include "program/output/report.hpp"

namespace riis::program {

struct Case {
  MarkOptions options;  // the mesh, the times, the outputs, and a prefix for the arrays that all valves share
  std::vector<ValveSource> valves;
  std::vector<std::string> files;  // all files that were read; no output may replace one of them
  Seconds seconds{};               // of reading them

  bool has_resistance() const;
  bool is_series() const { return !options.series.times.empty(); }
  // Returns the times of the series, or the only time.
  std::vector<double> times() const;
  // Returns the name for the files and columns of one valve, or "" if it is the only valve.
  std::string part_of(std::size_t valve) const { return valves.size() == 1 ? "" : valves[valve].options.prefix; }
  // Returns the beginning of a line about one valve, such as "mitral: ", or "" if it is the only valve.
  std::string before(std::size_t valve) const { return valves.size() == 1 ? "" : part_of(valve) + ": "; }
  // Returns the name of a valve's surface in warnings.
  std::string surface_of(std::size_t valve) const;
};

// Returns the valve or the surface of the command line as a case. The case has the options' opening and time, or the options'
// times and cycle. Reads a surface only for a series, whose outputs must not replace its frames.
Case case_of_command_line(const MarkOptions &options);
// Reads the surfaces of the valves that are in files and not read yet.
void read_surfaces(Case &all);

// Reads the case file of --case, JSON that describes the valves of a mesh with their placements and motions. Paths in the file
// are relative to the file's folder. Refusals name the file, the valve and the key. The command line's mesh, times, distance
// limit, resistance and points of --between replace those in the file.
Case read_case(const MarkOptions &options);

// The law of the opening of a valve in a case.
struct CaseOpening {
  OpeningLaw law;
  std::string file;  // the file that was read, or "" if there was none
};

// Reads a number or an object. An object is {"file"} or {"times", "openings"}, each with "period" and "interpolation", or it is
// {"opening_start", "opening_duration", "closing_start", "closing_duration", "closed", "open", "period"}. in_folder turns a path
// of the case file into a path relative to the working folder.
CaseOpening case_opening(const CaseValues &valve, const std::function<std::string(const std::string &)> &in_folder);

}  // namespace riis::program
