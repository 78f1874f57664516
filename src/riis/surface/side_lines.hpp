// SPDX-License-Identifier: Apache-2.0
// In: the triangles of a valve. Out: sides of its patches as lines through vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/vec3.hpp"
#include "surface/triangle_set.hpp"

namespace riis {

using Line = std::vector<Vec3>;

inline double line_length(const Line &line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += distance(line[i - 1], line[i]);
  return length;
}

struct SideLine {
  std::int32_t leaflet_id;
  Line line;  // vertices by ascending u
};

// A leaflet's free edge: the sides v = 1 of its patches that no other patch of the leaflet has. Ascending by patch.
std::vector<SideLine> free_edges(const TriangleSet &set);

// The sides v = 0 that no other patch has, and that have a length. Ascending by patch.
std::vector<SideLine> attachment(const TriangleSet &set);

}  // namespace riis
