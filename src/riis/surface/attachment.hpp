// SPDX-License-Identifier: Apache-2.0
// The attachment of a valve: the sides at which its patches are held (valve/patches.hpp), unless another patch has the side too
// (surface/rims.hpp).
// In: the triangles of a valve. Out: edges along the sides, through all of their vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/triangle_set.hpp"

namespace riis {

// Edges ascend by patch, and along a side by its parameter.
struct Attachment {
  std::vector<double> edges;             // (3, 2, n_edges)
  std::vector<std::int64_t> vertex_id;   // (2, n_edges)
  std::vector<std::int32_t> leaflet_id;  // (n_edges)
  std::vector<std::int32_t> patch_id;    // (n_edges)

  std::int64_t n_edges() const { return view(leaflet_id).size(); }
};

// Returns no edges for a surface from arrays. Edges without length are left out.
Attachment attachment_of(const TriangleSet &set);

}  // namespace riis
