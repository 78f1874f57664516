// SPDX-License-Identifier: Apache-2.0
// Compares the cost of riis_adjacency_create_from_cells with the cost of its former loop.
#pragma once

#include <cstdint>

#include "shared/contest.hpp"

namespace bench {

// Adds bars (required ratios) for times and for peak memory. The mesh has the tetrahedra of a cylinder. The nodes are numbered in
// order in one case, and at random in another case. Returns false if the rows differ. Call this function before other threads
// start, because it forks processes to measure memory.
bool compare_adjacencies(Contest &contest, Bars &bars, std::int64_t about_n_nodes, nlohmann::json &counts);

}  // namespace bench
