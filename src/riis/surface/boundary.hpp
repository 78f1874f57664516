// SPDX-License-Identifier: Apache-2.0
// The open boundary of triangles: the edges that only one triangle has.
// In: triangles, whose vertices may be repeated. Out: open edges, and the longest closed line of them.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/triangle_set.hpp"

namespace riis {

// An open edge, in the direction in which it runs round its triangle.
struct OpenEdge {
  std::int64_t from, to;  // vertices, each of which stands for all vertices with the same coordinates
  std::int64_t triangle;  // the position of its triangle in the set
};

// Returns the edges that only one triangle has, in the order of the triangles. If by_leaflet is true, only triangles of the same
// leaflet count. A vertex inside a neighbour's edge opens no edge, because the edges on both sides cancel.
std::vector<OpenEdge> open_edges(const TriangleSet &set, bool by_leaflet);

// Returns the edges of the longest closed line of open edges, in order. Returns nothing if there is none. If several lines meet
// in one vertex, each line continues along other triangles than before. So the attachments of cusps that meet at commissures make
// one line, and their free edges make another.
std::vector<OpenEdge> longest_boundary(const TriangleSet &set);

}  // namespace riis
