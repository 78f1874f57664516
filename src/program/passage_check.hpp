// SPDX-License-Identifier: Apache-2.0
// In: a marked mesh and two points. Out: whether unmarked nodes join them, where, and the half thickness that would part them.
#pragma once

#include <riis/riis_vtk.h>

#include <optional>
#include <string>
#include <vector>

#include "program/case.hpp"
#include "program/command_line.hpp"
#include "program/leaks.hpp"
#include "program/moving_valve.hpp"
#include "program/report.hpp"

namespace riis::program {

// The two values of --check-leaks; nothing for an empty list.
std::optional<LeakCheck> parse_leak_check(const std::vector<std::string> &points);

// Both write report.leaks.passage, and warn on stderr if the points are joined. They do nothing unless the options have points.
// The mesh loses its adjacency.
void check_passage(const Options &options, const MarkedMesh &marked, Report &report);
// All valves together where they are, which must have the same half thickness.
void check_passage_of(const Case &all, const std::vector<MovingValve> &valves, riis_mesh *mesh,
                      const riis_vtk_mesh *file, Report &report);

}  // namespace riis::program
