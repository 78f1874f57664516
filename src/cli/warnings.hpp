// SPDX-License-Identifier: Apache-2.0
// In: the number of marks and all sizes. Out: the line that tells what looks wrong and what to write instead.
#pragma once

#include <riis/riis_vtk.h>

#include <string>

#include "cli/command_line.hpp"

namespace riis::cli {

struct Box {
  double lower[3], upper[3];
  double largest_side() const;
};

// A marking with the sizes of its mesh and surface, in the mesh's unit.
struct Situation {
  const Options &options;
  int64_t n_nodes, n_marked;
  Box mesh, surface;
  double median_edge;  // of the mesh; 0 if unknown
  double area;         // of the surface
  double half_thickness;
};

Situation situation_of(const Options &options, const riis_surface_info &surface, const riis_mark_stats &marks,
                       const riis_vtk_mesh *mesh);

// "" if nothing looks wrong. Without line breaks.
std::string warning_of(const Situation &situation);

// Prints the line on stderr. --quiet does not silence it, because wrong marks look like right ones.
void warn(const std::string &text);

}  // namespace riis::cli
