// SPDX-License-Identifier: Apache-2.0
// Triangles in space as every later stage sees them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/strided.hpp"

namespace riis {

// Triangles by groups of neighbours, for searches: positions in the set, group after group, and where each group ends.
struct Grouping {
  std::vector<std::int32_t> order, end;
};

struct TriangleSet {
  std::vector<double> xyz;                // (3, n_vertices), placed
  std::vector<double> uv;                 // (2, n_vertices), empty for surfaces from arrays
  std::vector<std::int64_t> vertex_id;    // (3, n_triangles)
  std::vector<std::int64_t> triangle_id;  // (n_triangles), ascending
  std::vector<std::int32_t> leaflet_id;   // (n_triangles)
  std::vector<std::int32_t> patch_id;     // (n_triangles)
  std::int64_t n_zero_area = 0;           // left out
  Grouping grouping;                      // empty where whoever made the triangles knows nothing of it

  std::size_t n_vertices() const { return xyz.size() / 3; }
  std::size_t n_triangles() const { return triangle_id.size(); }
  Vec3 vertex(std::int64_t id) const {
    const double *v = xyz.data() + 3 * id;
    return {v[0], v[1], v[2]};
  }
  std::array<Vec3, 3> corners(std::size_t triangle) const {
    const std::int64_t *id = vertex_id.data() + 3 * triangle;
    return {vertex(id[0]), vertex(id[1]), vertex(id[2])};
  }
};

// The library takes on this many triangles: four-byte ids and a few hundred bytes each, with room.
inline constexpr std::int64_t max_triangles = 16'777'216;

// Height over the longest edge at most 1e-12 of that edge, or nothing longer than min_edge.
inline bool has_zero_area(Vec3 a, Vec3 b, Vec3 c) {
  const double longest = std::sqrt(std::fmax(dot(b - a, b - a), std::fmax(dot(c - b, c - b), dot(a - c, a - c))));
  if (!(longest >= min_edge)) return true;
  // Scaled to a longest edge of 1, so that small triangles do not underflow.
  const Vec3 ab = (1.0 / longest) * (b - a), ac = (1.0 / longest) * (c - a);
  return !(length(cross(ab, ac)) > 1e-12);
}

}  // namespace riis
