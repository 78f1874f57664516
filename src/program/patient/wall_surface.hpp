// SPDX-License-Identifier: Apache-2.0
// In: the file of a wall. Out: one closed surface whose triangles face outwards, or a refusal that says how to repair the file.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/array_view.hpp"
#include "common/vectors.hpp"

namespace riis::program {

using Corners = std::array<std::int64_t, 3>;

// Triangles with common vertices.
struct Triangles {
  std::vector<Vector3> points;
  std::vector<Corners> corners;

  std::int64_t n() const { return static_cast<std::int64_t>(corners.size()); }
  const Vector3 &corner(std::int64_t triangle, std::size_t k) const { return view(points)[view(corners)[triangle][k]]; }
  // Returns half the cross product of two sides: the area times the unit normal.
  Vector3 area_of(std::int64_t triangle) const;
  Vector3 centre_of(std::int64_t triangle) const;
  // Returns the distance of a point from a triangle.
  double distance(std::int64_t triangle, const Vector3 &from) const;
  // Returns the diagonal of the box around the points.
  double size() const;
  // Returns the volume inside, if the triangles are closed and face outwards.
  double volume() const;
};

// Returns for each triangle the triangles beyond its three sides. Side k goes from corner k to the next corner. Each side must
// have exactly two triangles.
std::vector<Corners> neighbours_of(const Triangles &triangles);

// A hole that was flat enough to be closed by a fan of triangles.
struct ClosedHole {
  std::int64_t first = 0, n_triangles = 0;  // the triangles of the fan
  Vector3 centre{};
};

struct ClosedSurface {
  Triangles triangles;               // closed, in one piece, facing outwards
  std::vector<ClosedHole> holes;     // whose fans are the last triangles
  std::vector<std::string> remarks;  // what was changed, a line each
};

// Reads and repairs the surface. Vertices at equal places become one. Refuses what flat_ends.hpp says of read_patient_wall.
ClosedSurface read_closed_surface(const std::string &path);

// Returns a point as the user writes it after an option: X,Y,Z with digits down to a thousandth of the size.
std::string point_text(const Vector3 &point, double size);

}  // namespace riis::program
