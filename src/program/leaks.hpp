// SPDX-License-Identifier: Apache-2.0
// In: a marked mesh. Out: the number of its edges that cross the surface between unmarked nodes, and a half thickness that
// closes these leaks.
#pragma once

#include <riis/riis_vtk.h>

#include <optional>
#include <string>
#include <vector>

#include "program/case.hpp"
#include "program/moving_valve.hpp"
#include "program/options.hpp"
#include "program/report.hpp"

namespace riis::program {

struct MarkedMesh {
  const riis_surface *surface;
  const riis_valve *valve;  // the valve of the surface; null for a surface from a file
  const riis_vtk_mesh *file;
  riis_mesh *mesh;  // the check for leaks removes its adjacency
  riis_marks *result;
  std::string surface_name = "the surface";  // the surface's name in the warning
};

// Rounds up to three digits, so that the number also closes the leaks when the user types it as printed.
double rounded_up(double x);

// Writes report.leaks and report.seconds.leaks. Warns on stderr if the surface leaks or if leaks are unknown. If two points are
// checked, check_passage warns instead.
void look_for_leaks(const MarkOptions &options, const MarkedMesh &marked, Report &report);

// Writes report.flow, except for the first passage, if the options request measures or stats. Removes the mesh's adjacency.
void measure_flow(const MarkOptions &options, const MarkedMesh &marked, Report &report);

// In: a marked mesh and two points. Out: whether unmarked nodes join the points, the position of the passage, and a half
// thickness that closes it.

// Returns the check for the two points of --between.
LeakCheck leak_check_between(const std::vector<std::string> &points);

// Both functions write report.leaks.passage, and warn on stderr if the points are joined. They do nothing if the options have no
// points. They remove the mesh's adjacency.
void check_passage(const MarkOptions &options, const MarkedMesh &marked, Report &report);
// Checks all valves together at their present positions. They must have the same half thickness.
void check_passage_of(const Case &all, const std::vector<MovingValve> &valves, riis_mesh *mesh,
                      const riis_vtk_mesh *file, Report &report);

}  // namespace riis::program
