// SPDX-License-Identifier: Apache-2.0
// Finds two kinds of sides of patches: the free edges of leaflets, and the attachment, where tissue or a stent holds a leaflet.
// In: the triangles of a valve. Out: the vertices along each side, and the edges of the attachment.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/triangle_set.hpp"

namespace riis {

// One side of one patch. Its length is above 0.
struct SideLine {
  std::int32_t leaflet_id, patch_id;
  Vector<std::int64_t> vertex_id;  // in order along the side; no two vertices have the same parameter
  AxisLine axis;                   // axis of the patch, placed
};

double length_of(const TriangleSet &set, const SideLine &side);

// free_edges and attached_sides return the sides in the order of their patches. A surface from arrays has no sides.
// A leaflet's free edge consists of the sides v = 1 that only one patch of the leaflet has.
std::vector<SideLine> free_edges(const TriangleSet &set);
// The attachment consists of the sides that Patch::attached names (valve/patches.hpp). A side that two patches share does not
// belong to it.
std::vector<SideLine> attached_sides(const TriangleSet &set);

// The edges of all attached sides. Their order is that of the patches. The edges of one side follow each other along the side.
// Edges of length 0 are left out.
struct Attachment {
  std::vector<double> edges;     // (3, 2, n_edges)
  std::vector<double> outwards;  // (3, 2, n_edges): the direction of a skirt, of length 1, or 0 without a direction
  std::vector<std::int64_t> vertex_id;   // (2, n_edges)
  std::vector<std::int32_t> leaflet_id;  // (n_edges)
  std::vector<std::int32_t> patch_id;    // (n_edges)

  std::int64_t n_edges() const { return view(leaflet_id).size(); }
};

Attachment attachment_of(const TriangleSet &set);

}  // namespace riis
