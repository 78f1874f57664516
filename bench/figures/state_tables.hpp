// SPDX-License-Identifier: Apache-2.0
// Reads tables of `riis states`.
// Input: a file KIND.csv from `riis states KIND.csv --valve KIND`. Output: its numbers.
#pragma once

#include <string>
#include <vector>

namespace riis::figures {

// A measure at every opening, and its ratio to the closed value, if the table has one.
struct Measure {
  std::vector<double> values, shares;
};

struct StateTable {
  std::string kind;  // the file's name without its ending
  std::vector<double> openings;
  std::vector<Measure> edges, areas;  // one per leaflet, by ascending id; edges is empty if the leaflets are rigid
  Measure orifice;
};

// Throws std::runtime_error with the file's name.
StateTable read_state_table(const std::string &path);

}  // namespace riis::figures
