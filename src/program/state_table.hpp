// SPDX-License-Identifier: Apache-2.0
// In: the states of a valve. Out: the table as CSV, and a summary for people.
#pragma once

#include <string>

#include "program/states.hpp"

namespace riis::program {

// opening, then NAME_edge, NAME_edge_ratio, NAME_area and NAME_area_ratio of each leaflet, then orifice_area. Ratios are to
// the closed state.
std::string csv_of(const States &states);

std::string summary_of(const States &states, const Options &options);

}  // namespace riis::program
