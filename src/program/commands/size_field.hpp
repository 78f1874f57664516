// SPDX-License-Identifier: Apache-2.0
// riis size-field. In: valves and their motion. Out: a grid of edge lengths, small near the valves, as gmsh reads it.
#pragma once

#include "program/base/options.hpp"
#include "program/base/refusal.hpp"

namespace riis::program {

// The largest number of points of the grid.
inline constexpr std::int64_t most_field_points = 20'000'000;

// Measures the distances of the grid's points to the valves at all times, and writes the edge lengths. Throws a Refusal.
ExitCode run_size_field(const SizeFieldOptions &options);

}  // namespace riis::program
