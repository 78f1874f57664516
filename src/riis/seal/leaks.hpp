// SPDX-License-Identifier: Apache-2.0
// Leaks: edges of the mesh that cross the surface between two unmarked nodes. The marks leave these paths open.
// In: a surface, a mesh with an adjacency, the marks. Out: the leaking edges in ascending order.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/vec3.hpp"
#include "marks/marks.hpp"
#include "search/search.hpp"

namespace riis {

// Edges between two unmarked nodes that cross the surface, in ascending order. riis_leak_list documents the members.
struct Leaks {
  std::vector<std::int64_t> node_id;  // (2, n)
  std::vector<double> length, distance;
  double half_thickness = 0;
  std::int64_t longest_node_id[2] = {-1, -1};
  double longest_length = 0;
  Vec3 longest_middle{0, 0, 0};
  double seconds = 0;
};

// Finds the leaks. Fails with RIIS_INVALID_MESH for an unusable coordinate. Does not use the request's distance limit.
Leaks find_leaks(const SearchRequest &request, const Marks &marks);

}  // namespace riis
