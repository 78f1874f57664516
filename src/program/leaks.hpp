// SPDX-License-Identifier: Apache-2.0
// In: a mesh that was marked. Out: how many of its edges cross the surface between unmarked nodes, and the half thickness that
// would close them.
#pragma once

#include <riis/riis_vtk.h>

#include <string>

#include "program/command_line.hpp"
#include "program/report.hpp"

namespace riis::program {

struct MarkedMesh {
  const riis_surface *surface;
  const riis_valve *valve;  // that the surface was made of; null for a surface from a file
  const riis_vtk_mesh *file;
  riis_mesh *mesh;  // loses its adjacency
  riis_marks *result;
  std::string surface_name = "the surface";  // in the warning
};

// Rounds to three digits, never below x, so that the number that a user types closes the leaks.
double rounded_up(double x);

// Writes report.leaks and report.seconds.leaks, and warns on stderr if flow passes, or if that is not known. If two points are
// checked, that check warns instead.
void look_for_leaks(const Options &options, const MarkedMesh &marked, Report &report);

}  // namespace riis::program
