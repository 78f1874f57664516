// SPDX-License-Identifier: Apache-2.0
// Pairs of triangles of a surface that go through each other: its self-intersections.
// In: triangles and their groups. Out: the pairs, ascending, with their depths and the segments that they have in common.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/triangle_groups.hpp"
#include "surface/triangle_set.hpp"

namespace riis {

struct Crossings {
  std::vector<std::int64_t> triangle;     // (2, n_pairs), positions in the set, the lower one first
  std::vector<std::int64_t> triangle_id;  // (2, n_pairs)
  std::vector<double> point;              // (3, n_pairs), the middle of the common segment
  std::vector<double> depth, length;      // (n_pairs)
};

// Finds pairs that are deeper in each other than `least_depth`. Triangles of one leaflet that share a vertex, by its coordinates,
// are no pair.
Crossings find_crossings(const TriangleSet &set, const TriangleGroups &groups, double least_depth, int n_threads);

}  // namespace riis
