// SPDX-License-Identifier: Apache-2.0
// The edges of a surface: the open boundary of triangles, the free edges of leaflets, and the attachment. At the attachment,
// tissue or a stent holds a leaflet.
// The triangles may repeat vertices.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "triangulate/triangle_set.hpp"

namespace riis {

// An open edge. Its direction is the direction that it has around its triangle.
struct OpenEdge {
  std::int64_t from, to;  // two vertices; each stands for all vertices with the same coordinates
  std::int64_t triangle;  // the position of its triangle in the set
};

// Returns the edges that only one triangle has, in the order of the triangles. If by_leaflet is true, each leaflet is examined
// alone. If short edges of some triangles cover a long edge of another triangle, none of these edges is open.
std::vector<OpenEdge> open_edges(const TriangleSet &set, bool by_leaflet);

// Returns the closed lines of open edges, each in order. If several lines meet in one vertex, a line continues along triangles
// that it has not passed yet. If cusps meet at commissures, their attachments thus form one line, and their free edges form
// another line.
std::vector<std::vector<OpenEdge>> closed_boundaries(const TriangleSet &set);
// The closed line of open edges that encloses the largest vector area, and the size of the second largest vector area.
struct LargestBoundary {
  std::vector<OpenEdge> edges;  // empty if no closed line encloses an area
  Vec3 area{0, 0, 0};
  double second_area = 0;
};
LargestBoundary largest_boundary(const TriangleSet &set);
// Takes the open edges from the caller. Where the caller has reversed an open edge, the edge's triangle is treated as turned
// over.
LargestBoundary largest_boundary(const TriangleSet &set, const std::vector<OpenEdge> &edges);
// Returns the edges of the longest closed line of open edges, or nothing if there is no closed line.
std::vector<OpenEdge> longest_boundary(const TriangleSet &set);

// One side of one patch. Its length is above 0.
struct SideLine {
  std::int32_t leaflet_id, patch_id;
  Vector<std::int64_t> vertex_id;  // in order along the side; no two vertices have the same parameter
  AxisLine axis;                   // axis of the patch, placed
};

double length_of(const TriangleSet &set, const SideLine &side);

// free_edges and attached_sides return sides in the order of their patches. A surface from arrays has no sides. The free edge of
// a leaflet consists of those sides v = 1 that only one patch of the leaflet has.
std::vector<SideLine> free_edges(const TriangleSet &set);
// The attachment consists of the sides that Patch::attached names (valve/patches.hpp). A side that two patches share does not
// belong to the free edge.
std::vector<SideLine> attached_sides(const TriangleSet &set);
// The boundary of the leaflets consists of the free edges, the attached sides, and every other side that only one patch has.
// Sides of the leaflet `skirt` are left out.
std::vector<SideLine> boundary_sides(const TriangleSet &set, std::int32_t skirt);

// The edges of all attached sides. The edges are in the order of the patches. The edges of one side follow each other along the
// side. Edges of length 0 are left out.
struct Attachment {
  std::vector<double> edges;             // (3, 2, n_edges)
  std::vector<double> outwards;          // (3, 2, n_edges): a skirt's unit direction at both ends of the edge, or 0
  std::vector<std::int64_t> vertex_id;   // (2, n_edges)
  std::vector<std::int32_t> leaflet_id;  // (n_edges)
  std::vector<std::int32_t> patch_id;    // (n_edges)

  std::int64_t n_edges() const { return view(leaflet_id).size(); }
};

Attachment attachment_of(const TriangleSet &set);

// A straight part of a leaflet's free edge.
struct EdgePart {
  std::int32_t leaflet_id;
  Vec3 from, to;
};

// Returns the straight parts of the leaflets' free edges.
std::vector<EdgePart> free_edge_parts(const TriangleSet &set);

// Returns the leaflets, ascending by id.
std::vector<riis_leaflet> leaflets_of(const TriangleSet &set);

// Returns the area of all leaflets except one.
double area_without(const std::vector<riis_leaflet> &leaflets, std::int32_t leaflet_id);

}  // namespace riis
