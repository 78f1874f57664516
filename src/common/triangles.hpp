// SPDX-License-Identifier: Apache-2.0
// Triangles with common vertices, their sides, and the triangles beyond these sides.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "common/array_view.hpp"
#include "common/vectors.hpp"

namespace riis {

// Triangles with common vertices.
struct Triangles {
  using Corners = std::array<std::int64_t, 3>;
  std::vector<Vector3> points;
  std::vector<Corners> corners;

  std::int64_t n() const { return static_cast<std::int64_t>(corners.size()); }
  const Vector3 &corner(std::int64_t triangle, std::size_t k) const { return view(points)[view(corners)[triangle][k]]; }
  // Returns half the cross product of two sides: the area times the unit normal.
  Vector3 area_of(std::int64_t triangle) const {
    const Vector3 &a = corner(triangle, 0);
    return 0.5 * cross(corner(triangle, 1) - a, corner(triangle, 2) - a);
  }
  Vector3 centre_of(std::int64_t triangle) const {
    return 1.0 / 3 * (corner(triangle, 0) + corner(triangle, 1) + corner(triangle, 2));
  }
  // Returns the distance of a point from a triangle.
  double distance(std::int64_t triangle, const Vector3 &from) const {
    const Vector3 normal = unit_vector(area_of(triangle));
    bool is_above = norm(normal) > 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 &a = corner(triangle, k);
      const Vector3 side = corner(triangle, (k + 1) % 3) - a, to = from - a;
      if (dot(cross(normal, side), to) < 0) is_above = false;
      const double square = dot(side, side);
      const double share = square > 0 ? std::clamp(dot(to, side) / square, 0.0, 1.0) : 0;
      nearest = std::min(nearest, norm(to - share * side));
    }
    return is_above ? std::min(nearest, std::abs(dot(from - corner(triangle, 0), normal))) : nearest;
  }
  // Returns the diagonal of the box around the points.
  double size() const {
    Vector3 lower = points[0], upper = points[0];
    for (const Vector3 &point : points)
      for (std::size_t k = 0; k < 3; ++k) {
        lower[k] = std::min(lower[k], point[k]);
        upper[k] = std::max(upper[k], point[k]);
      }
    return norm(upper - lower);
  }
  // Returns the volume inside, if the triangles are closed and face outwards.
  double volume() const {
    double volume = 0;
    const Vector3 origin = points[0];  // near the surface, for the sake of rounding
    for (std::int64_t i = 0; i < n(); ++i) volume += dot(centre_of(i) - origin, area_of(i)) / 3;
    return volume;
  }
};

// A side of a triangle, between two vertices a < b.
struct TriangleSide {
  std::int64_t a, b, triangle;
  std::size_t k;    // which side of the triangle
  bool is_forward;  // whether the triangle goes from a to b
};

// Returns the sides of all triangles, sorted so that the sides at one edge follow each other.
inline std::vector<TriangleSide> sorted_sides(const std::vector<Triangles::Corners> &corners) {
  std::vector<TriangleSide> sides;
  sides.reserve(3 * corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t from = corners[i][k], to = corners[i][(k + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), static_cast<std::int64_t>(i), k, from < to});
    }
  std::sort(sides.begin(), sides.end(), [](const TriangleSide &s, const TriangleSide &t) {
    return std::tie(s.a, s.b, s.triangle) < std::tie(t.a, t.b, t.triangle);
  });
  return sides;
}

// Calls `visit` for each edge, with the first triangle side at the edge and the number of triangle sides there.
template <class Visit>
void for_each_edge(const std::vector<TriangleSide> &sides, const Visit &visit) {
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].a == sides[i].a && sides[end].b == sides[i].b) ++end;
    visit(&sides[i], end - i);
  }
}

// Returns for each triangle the neighbours beyond its three sides. A neighbour is -1 if the edge does not have exactly two
// triangles. Side k goes from corner k to the next corner.
inline std::vector<Triangles::Corners> neighbours_of(const Triangles &triangles) {
  std::vector<Triangles::Corners> beyond(triangles.corners.size(), {-1, -1, -1});
  for_each_edge(sorted_sides(triangles.corners), [&](const TriangleSide *side, std::size_t n_sides) {
    if (n_sides != 2) return;
    view(beyond)[side[0].triangle][side[0].k] = side[1].triangle;
    view(beyond)[side[1].triangle][side[1].k] = side[0].triangle;
  });
  return beyond;
}

}  // namespace riis
