// SPDX-License-Identifier: Apache-2.0
// In: measures of a valve at some openings. Out: a figure of the valve at these openings, from above and from the side, with
// the measures in a table.
#pragma once

#include <array>
#include <string>

#include "figures/page.hpp"
#include "figures/state_tables.hpp"

namespace riis::figures {

// The kinds in the order of the page.
inline constexpr std::array<const char *, 4> kinds_with_states = {"aortic", "trileaflet", "mitral", "bileaflet"};

// Refuses a table of another kind, of other leaflets or of other openings by a std::runtime_error.
void check_table(const StateTable &table);

Figure states_figure(const StateTable &table);

// Says how to get the figure (HTML).
std::string how_to_show_states(const std::string &kind);

}  // namespace riis::figures
