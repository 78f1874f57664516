// SPDX-License-Identifier: Apache-2.0
// The boundary of leaflets, from the triangles of a valve or of arrays (docs/theory/measures.md, "Outline"). For arrays, this
// file also finds the closed lines of open edges at which the leaflets may be attached.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/vec3.hpp"
#include "triangulate/triangle_set.hpp"

namespace riis {

// A straight part of the leaflets' boundary.
struct BoundaryEdge {
  Vec3 from, to;
  std::int64_t piece;  // counted from 0: the connected part of a leaflet to which this edge belongs
};

// A closed line of open edges, in order.
struct ClosedLine {
  std::vector<BoundaryEdge> edges;
  double area;  // the size of its vector area
};

// The boundary of the leaflets.
struct LeafletBoundary {
  std::vector<BoundaryEdge> edges;
  std::vector<ClosedLine> perhaps_attached;  // for triangles from arrays, a line for each winding of the pieces
  std::vector<Vec3> centroids;               // of the pieces
  Vec3 normal;                               // the sum of the triangles' areas times their normals
};

// Returns the patches' sides at which leaflets end, or the open edges of triangles from arrays. Leaves out a skirt.
LeafletBoundary boundary_of_leaflets(const TriangleSet &set);

// Returns the longest connected line of open edges of a wall, as a boundary without centroids and normal.
LeafletBoundary boundary_of_wall(const TriangleSet &wall);

}  // namespace riis
