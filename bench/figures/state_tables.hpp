// SPDX-License-Identifier: Apache-2.0
// In: a file KIND.csv that `riis states KIND.csv --valve KIND` wrote. Out: its numbers.
#pragma once

#include <string>
#include <vector>

namespace riis::figures {

// A measure at every opening, and its share of the closed value. A measure without shares has none.
struct Measure {
  std::vector<double> values, shares;
};

struct StateTable {
  std::string kind;  // the file's name without its ending
  std::vector<double> openings;
  std::vector<Measure> edges, areas;  // of the leaflets by ascending id; no edges if the leaflets are rigid
  Measure orifice;
};

// Throws a std::runtime_error that names the file.
StateTable read_state_table(const std::string &path);

}  // namespace riis::figures
