// SPDX-License-Identifier: Apache-2.0
// Self-intersections of a surface: pairs of triangles that go through each other.
// In: triangles and their groups. Out: the pairs in ascending order, with their depths and common segments.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/triangle_groups.hpp"
#include "triangulate/triangle_set.hpp"

namespace riis {

struct Crossings {
  std::vector<std::int64_t> triangle;     // (2, n_pairs), positions in the set, the lower one first
  std::vector<std::int64_t> triangle_id;  // (2, n_pairs)
  std::vector<double> point;              // (3, n_pairs), the middle of the common segment
  std::vector<double> depth, length;      // (n_pairs)
};

// Finds the pairs of triangles that penetrate each other by more than `least_depth`. Two triangles of one leaflet that share a
// vertex do not count as a pair. Vertices are shared if their coordinates are equal.
Crossings find_crossings(const TriangleSet &set, const TriangleGroups &groups, double least_depth, int n_threads);

}  // namespace riis
