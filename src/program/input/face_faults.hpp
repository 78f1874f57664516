// SPDX-License-Identifier: Apache-2.0
// The input is a surface from a file. The results are lines of open edges, and warnings about triangles that the user probably
// did not intend.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <string>
#include <vector>

#include "common/triangles.hpp"
#include "program/base/options.hpp"

namespace riis::program {

// Returns the corners of the triangles. Corners at equal positions are one vertex.
std::vector<Triangles::Corners> joined_corners(const riis_triangles &triangles);

// Warns of triangles turned against their neighbours, leaflets turned over as a whole, equal triangles, and closed pieces such as
// thick leaflets. The warnings begin with the names of the files of --surface.
void warn_of_faces(const ValveOptions &options, const riis_surface *surface);

// A line of open edges: the number of its edges, their total length, and the middle of the box around the line.
struct OpenLine {
  std::int64_t n_edges = 0;
  double length = 0, point[3] = {0, 0, 0};
};
// Returns the longest line of open edges whose length is at most the given length. Lines that meet count as one line.
OpenLine longest_open_line(const riis_surface *surface, double most);

}  // namespace riis::program
