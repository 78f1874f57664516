// SPDX-License-Identifier: Apache-2.0
// Ties: triangles of other leaflets, or of other patches of one leaflet, that are as near to a point as its closest triangle
// (docs/theory.md, section 10). Only velocities need them. In: triangles, as searches compare them. Out: the ties of each point,
// whatever the order was.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/point_triangle.hpp"

namespace riis {

struct TieRule {
  const std::int32_t *leaflet_id = nullptr, *patch_id = nullptr;  // of each triangle; null if ties are not wanted
  // Distances to two leaflets, and to two patches of one leaflet, count as equal up to these differences.
  double of_leaflets = 0, of_patches = 0;

  bool is_tie(const ClosestTriangle &closest, const ClosestTriangle &other) const {
    const std::int64_t a = closest.triangle, b = other.triangle;
    const bool is_one_leaflet = leaflet_id[a] == leaflet_id[b];
    if (is_one_leaflet && patch_id[a] == patch_id[b]) return false;
    return std::sqrt(other.distance_sq) <= std::sqrt(closest.distance_sq) + (is_one_leaflet ? of_patches : of_leaflets);
  }
  bool are_of_one_patch(const ClosestTriangle &a, const ClosestTriangle &b) const {
    return leaflet_id[a.triangle] == leaflet_id[b.triangle] && patch_id[a.triangle] == patch_id[b.triangle];
  }
};

struct Tie {
  std::int64_t point;  // a number of the search's own, then a node
  ClosestTriangle triangle;
};

// The ties that one thread of a search finds. The closest triangle of each patch that ties is among them. Farther ones may be.
struct Ties {
  TieRule rule;
  std::vector<Tie> candidates;  // of points that still may get nearer triangles
  std::vector<Tie> found;       // of nodes

  // Keeps the farther one of two triangles of a point, if it may be a tie. `closest` is the nearest that was met. Another
  // triangle of its patch is no tie, now or later: either this patch stays the nearest, or `closest` itself is kept.
  void compare(std::int64_t point, const ClosestTriangle &closest, const ClosestTriangle &other) {
    if (other.triangle < 0 || !rule.is_tie(closest, other)) return;
    if (!candidates.empty()) {
      // The triangles around a vertex are often met one after the other. One of them is enough.
      Tie &last = candidates.back();
      if (last.point == point && rule.are_of_one_patch(last.triangle, other)) {
        if (is_closer(other.distance_sq, other.triangle, last.triangle)) last.triangle = other;
        return;
      }
    }
    candidates.push_back({point, other});
  }

  // Takes the ties among the candidates, once all points are decided. closest_to(point) returns the closest triangle, or -1 for
  // none. node_of(point) returns the node.
  template <class ClosestTo, class NodeOf>
  void settle(const ClosestTo &closest_to, const NodeOf &node_of) {
    for (const Tie &tie : candidates) {
      const ClosestTriangle &closest = closest_to(tie.point);
      if (closest.triangle >= 0 && rule.is_tie(closest, tie.triangle))
        found.push_back({node_of(tie.point), tie.triangle});
    }
    candidates.clear();
  }
};

}  // namespace riis
