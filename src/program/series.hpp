// SPDX-License-Identifier: Apache-2.0
// A series in time. The mesh is read once. A first pass over the times finds the nodes near the region that the valves sweep. A
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

// Returns exit_fine, or exit_none_marked if no node was marked at any time and the user did not allow that. Throws a Refusal.
ExitCode run_series(Case &all);

// In: valves that move through a mesh. Out: the nodes that are near a valve at some time, and the box that contains all motion.

struct Sweep {
  std::vector<std::int64_t> node_ids;  // the nodes within the distance limit at some time, ascending
  Box box;                             // the box around all surfaces at all times
  // For each valve, the values at the time when it marked most nodes.
  std::vector<std::int64_t> most_marked;
  std::vector<riis_surface_info> surface;
};

Sweep sweep_of(std::vector<MovingValve> &valves, const std::vector<double> &times, const riis_mesh *mesh,
               std::int64_t n_nodes, bool quiet);

}  // namespace riis::program
