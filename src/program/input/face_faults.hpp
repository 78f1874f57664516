// SPDX-License-Identifier: Apache-2.0
// In: a surface from a file. Out: lines on stderr about triangles that give other sides or areas than a user expects, and lines
// of open edges.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <string>

namespace riis::program {

// Warns of triangles that are turned over against their neighbours, of equal triangles, and of closed pieces such as thick
// leaflets. `name` begins the lines. Corners at equal positions are one vertex.
void warn_of_faces(const std::string &name, const riis_surface *surface);

// A line of open edges: the number of its edges, their length, and the middle of the box around it.
struct OpenLine {
  std::int64_t n_edges = 0;
  double length = 0, point[3] = {0, 0, 0};
};
// Returns the longest line of open edges that is at most so long. Lines that meet are one line.
OpenLine longest_open_line(const riis_surface *surface, double most);

}  // namespace riis::program
