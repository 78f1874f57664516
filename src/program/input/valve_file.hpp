// SPDX-License-Identifier: Apache-2.0
// In: a JSON file of boundary curves and patches. Out: a valve, with an open state if the file has one.
#pragma once

#include <string>
#include <utility>

#include "program/base/handles.hpp"

namespace riis::program {

// Returns whether --valve is a file, which ends in .json, and not a kind.
bool is_valve_file(const std::string &valve);

// {"curves": {"edge": [[0, 0, 0], [1, 0, 0]], ...},
//  "patches": [{"v0": "edge", "v1": "-rim", "u0": ..., "u1": ..., "leaflet": 0}, ...],
//  "open": {"curves": {"edge": ...}}}
// A curve with 2, 3 or 4 points has them as control points of degree 1, 2 or 3. A curve with 1 point is a side that is collapsed
// to it. A minus reverses the curve. "leaflet" (0 by default) and "open" may be left out. Refusals name the curve, or the
// patch by its number from 0.
class ValveFile {
 public:
  explicit ValveFile(const std::string &path);
  riis_valve *valve() const { return valve_.get(); }
  Valve take_valve() { return std::move(valve_); }
  // Refuses an opening that needs an open state if the file has none. The library's own message would advise another valve.
  void check_opening() const;

 private:
  std::string path_;
  Valve valve_;
  bool can_open_ = false;
};

}  // namespace riis::program
