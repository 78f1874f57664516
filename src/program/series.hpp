// SPDX-License-Identifier: Apache-2.0
// A series in time: the mesh is read once, and the nodes near the valves' sweep are found in a first pass over the times. A
// second pass marks and writes.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "program/case.hpp"
#include "program/moving_valve.hpp"
#include "program/refusal.hpp"
#include "program/warnings.hpp"

namespace riis::program {

// Returns exit_fine, or exit_none_marked if no node is marked at any time and the user did not allow that. Throws a Refusal.
ExitCode run_series(Case &all);

// In: valves that move through a mesh. Out: the nodes that are near one of them at any time, and the space that they move in.

struct Sweep {
  std::vector<std::int64_t> node_ids;  // within the distance limit at some time, ascending
  Box box;                             // of all surfaces at all times
  // For each valve, where it marked most nodes.
  std::vector<std::int64_t> most_marked;
  std::vector<riis_surface_info> surface;
};

Sweep sweep_of(std::vector<MovingValve> &valves, const std::vector<double> &times, const riis_mesh *mesh,
               std::int64_t n_nodes, bool quiet);

}  // namespace riis::program
