// SPDX-License-Identifier: Apache-2.0
// In: valves that move through a mesh. Out: the nodes that are near one of them at any time, and the space that they move in.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "program/moving_valve.hpp"
#include "program/warnings.hpp"

namespace riis::program {

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
