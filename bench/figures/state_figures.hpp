// SPDX-License-Identifier: Apache-2.0
// Draws a valve at some openings, from above and from the side.
// Input: measures of the valve at these openings. Output: a figure with the pictures and a table of the measures.
#pragma once

#include <array>
#include <string>

#include "figures/page.hpp"
#include "figures/state_tables.hpp"

namespace riis::figures {

// The kinds of valve, in the order of the page.
inline constexpr std::array<const char *, 5> kinds_with_states = {"aortic", "trileaflet", "coapting", "mitral",
                                                                  "bileaflet"};

// Throws std::runtime_error if the table is for another kind, other leaflets or other openings.
void check_table(const StateTable &table);

Figure states_figure(const StateTable &table);

// Returns a text (HTML) that says how to make the figure.
std::string how_to_show_states(const std::string &kind);

}  // namespace riis::figures
