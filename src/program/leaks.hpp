// SPDX-License-Identifier: Apache-2.0
// In: a mesh that was marked. Out: how many of its edges cross the surface between unmarked nodes, and the half thickness that
// would close them.
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
  riis_mesh *mesh;  // the check removes its adjacency
  riis_marks *result;
  std::string surface_name = "the surface";  // its name in the warning
};

// Rounds up to three digits. So the rounded number also closes the leaks when the user types it.
double rounded_up(double x);

// Writes report.leaks and report.seconds.leaks, and warns on stderr if the surface leaks or if leaks are unknown. If two points
// are checked, that check warns instead.
void look_for_leaks(const MarkOptions &options, const MarkedMesh &marked, Report &report);

// Writes report.flow but for the first passage, if the options request measures or stats. It removes the mesh's adjacency.
void measure_flow(const MarkOptions &options, const MarkedMesh &marked, Report &report);

// In: a marked mesh and two points. Out: whether unmarked nodes join the points, the place of the passage, and the half
// thickness that closes it.

// The two points of --between.
LeakCheck leak_check_between(const std::vector<std::string> &points);

// Both write report.leaks.passage, and warn on stderr if the points are joined. They do nothing unless the options have points.
// They remove the mesh's adjacency.
void check_passage(const MarkOptions &options, const MarkedMesh &marked, Report &report);
// Checks all valves together at their present places. They must have the same half thickness.
void check_passage_of(const Case &all, const std::vector<MovingValve> &valves, riis_mesh *mesh,
                      const riis_vtk_mesh *file, Report &report);

}  // namespace riis::program
