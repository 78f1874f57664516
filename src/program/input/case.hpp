// SPDX-License-Identifier: Apache-2.0
// A case: one or several valves in one mesh, at one time or at many. A valve that the command line describes is a case with one
// valve.
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
  // Returns the times of the series. Without a series, returns the only time.
  std::vector<double> times() const;
  // Returns a valve's name for files and columns, or "" if the case has only one valve.
  std::string part_of(std::size_t valve) const { return valves.size() == 1 ? "" : valves[valve].options.prefix; }
  // Returns the beginning of a line about a valve, such as "mitral: ", or "" if the case has only one valve.
  std::string before(std::size_t valve) const { return valves.size() == 1 ? "" : part_of(valve) + ": "; }
  // Returns the name that warnings use for a valve's surface.
  std::string surface_of(std::size_t valve) const;
};

// Returns the valve or the surface of the command line as a case. The options give the case its opening and its time. For a
// series, they give the times and the cycle. The surface of a series is read here, because no output of the series may replace a
// frame of the surface.
Case case_of_command_line(const MarkOptions &options);
// Reads the valves' surfaces from files. A surface that was read before is not read again.
void read_surfaces(Case &all);

// Reads the case file of --case. The case file is a JSON file with the valves of a mesh, their placements and their motions.
// Paths in the file are relative to the file's folder. Refusals name the file, the valve and the key. Some options of the command
// line replace values of the case file: the mesh, the times, the distance limit, the resistance and the points of --between.
Case read_case(const MarkOptions &options);

// The law for the opening of a valve in a case.
struct CaseOpening {
  OpeningLaw law;
  std::string file;  // the file that was read, or "" if there was none
};

// Reads a number or an object. An object is {"file"} or {"times", "openings"}, each with "period" and "interpolation". An object
// may also be {"opening_start", "opening_duration", "closing_start", "closing_duration", "closed", "open", "period"}. in_folder
// turns a path of the case file into a path relative to the working folder.
CaseOpening case_opening(const CaseValues &valve, const std::function<std::string(const std::string &)> &in_folder);

}  // namespace riis::program
