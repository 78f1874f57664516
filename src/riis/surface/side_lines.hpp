// SPDX-License-Identifier: Apache-2.0
// Sides of patches that mean something: the free edges of leaflets, and the attachment, where tissue or a stent holds them.
// In: the triangles of a valve. Out: the sides as vertices along them, and the attachment as edges.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/triangle_set.hpp"

namespace riis {

// A side that has a length.
struct SideLine {
  std::int32_t leaflet_id, patch_id;
  Vector<std::int64_t> vertex_id;  // ascending along the side, no two at the same parameter
};

double length_of(const TriangleSet &set, const SideLine &side);

// Both functions return sides ascending by patch, and none for a surface from arrays.
// A leaflet's free edge consists of the sides v = 1 of its patches that no other patch of the leaflet has.
std::vector<SideLine> free_edges(const TriangleSet &set);
// The attachment consists of the sides at which patches are held (valve/patches.hpp), unless another patch has the side too.
std::vector<SideLine> attached_sides(const TriangleSet &set);

// Edges ascend by patch, and along a side by its parameter. Edges without length are left out.
struct Attachment {
  std::vector<double> edges;             // (3, 2, n_edges)
  std::vector<std::int64_t> vertex_id;   // (2, n_edges)
  std::vector<std::int32_t> leaflet_id;  // (n_edges)
  std::vector<std::int32_t> patch_id;    // (n_edges)

  std::int64_t n_edges() const { return view(leaflet_id).size(); }
};

Attachment attachment_of(const TriangleSet &set);

}  // namespace riis
