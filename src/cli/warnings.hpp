// SPDX-License-Identifier: Apache-2.0
// In: what was marked, and how large everything is. Out: the line that tells what looks wrong and what to write instead.
#pragma once

#include <riis/riis_vtk.h>

#include <string>

#include "cli/command_line.hpp"

namespace riis::cli {

struct Box {
  double lower[3], upper[3];
  double largest_side() const;
};

// A marking, with the sizes of what took part in it, in the mesh's unit.
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

// Says it on stderr, however quiet the user wants the program: marks that are wrong look like marks that are right.
void warn(const std::string &text);

}  // namespace riis::cli
