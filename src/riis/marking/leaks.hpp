// SPDX-License-Identifier: Apache-2.0
// Edges of the mesh that cross the surface between two unmarked nodes: paths that the marks leave open.
// In: a surface, a mesh with an adjacency, a marking's marks. Out: these edges, ascending.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/vec3.hpp"
#include "marking/marks.hpp"
#include "marking/search.hpp"

namespace riis {

// Edges between two unmarked nodes that cross the surface, ascending. riis_leak_list explains the members.
struct Leaks {
  std::vector<std::int64_t> node_id;  // (2, n)
  std::vector<double> length, distance;
  double half_thickness = 0;
  std::int64_t longest_node_id[2] = {-1, -1};
  double longest_length = 0;
  Vec3 longest_middle{0, 0, 0};
  double seconds = 0;
};

// Fails with RIIS_INVALID_MESH if a coordinate is not usable. Does not use the request's limit.
Leaks find_leaks(const SearchRequest &request, const Marks &marks);

}  // namespace riis
