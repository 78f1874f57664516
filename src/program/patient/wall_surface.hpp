// SPDX-License-Identifier: Apache-2.0
// The input is the file of a wall. The result is a closed surface whose triangles face outwards, or a refusal that says how to
// repair the file.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/triangles.hpp"

namespace riis::program {

using riis::Triangles;
using Corners = Triangles::Corners;

// A hole that was flat enough to be closed. A fan of triangles closes the hole.
struct ClosedHole {
  std::int64_t first = 0, n_triangles = 0;  // the triangles of the fan
  Vector3 centre{};
};

struct ClosedSurface {
  Triangles triangles;               // closed, in one piece, facing outwards
  std::vector<ClosedHole> holes;     // whose fans are the last triangles
  std::vector<std::string> remarks;  // what was changed, a line each
};

// Reads and repairs the surface. Vertices at one place become one vertex. Refuses a surface that read_patient_wall
// (flat_ends.hpp) would refuse.
ClosedSurface read_closed_surface(const std::string &path);

// Returns a point in the form X,Y,Z, as the user writes it after an option, with digits down to a thousandth of the size.
std::string point_text(const Vector3 &point, double size);

}  // namespace riis::program
