// SPDX-License-Identifier: Apache-2.0
// In: the surfaces of several valves. Out: their triangles in one surface, with leaflets numbered on from valve to valve.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "program/handles.hpp"
#include "program/moving_valve.hpp"

namespace riis::program {

// One more than the largest id.
int32_t n_leaflets_of(const riis_surface *surface);
// Returns each valve's first leaflet among the leaflets of all valves, and the number of all.
std::vector<int32_t> first_leaflets(const std::vector<MovingValve> &valves);
// options may be NULL, for the defaults.
Surface joined_surface(const std::vector<MovingValve> &valves, const riis_surface_options *options = nullptr);

}  // namespace riis::program
