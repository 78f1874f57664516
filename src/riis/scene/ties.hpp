// SPDX-License-Identifier: Apache-2.0
// Ties: triangles that are as near to a point as its closest triangle, and that belong to another leaflet, or to another patch
// of the same leaflet (docs/theory/marks.md, "Equally near leaflets"). Only velocities need ties.
// In: triangles in the order in which a search compares them. Out: the ties of each point, which do not depend on this order.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/point_triangle.hpp"

namespace riis {

struct TieRule {
  const std::int32_t *leaflet_id = nullptr, *patch_id = nullptr;  // for each triangle; null if ties are not wanted
  // Two distances count as equal if they differ by at most of_leaflets for two leaflets, or by at most of_patches for two patches
  // of one leaflet.
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
  std::int64_t point;  // the query point's number, which the search chooses; at last a node
  ClosestTriangle triangle;
};

// The ties that one thread of a search finds. For each patch that ties, they contain its closest triangle, and perhaps also
// farther ones.
struct Ties {
  TieRule rule;
  std::vector<Tie> candidates;  // ties of points that may still get nearer triangles
  std::vector<Tie> found;       // ties of nodes

  // Compares two triangles of a point, of which `closest` is the nearest so far. Keeps `other` as a candidate if it may be a
  // tie. A triangle on the patch of `closest` is never needed: either this patch stays the nearest, or `closest` itself becomes
  // a candidate.
  void compare(std::int64_t point, const ClosestTriangle &closest, const ClosestTriangle &other) {
    if (other.triangle < 0 || !rule.is_tie(closest, other)) return;
    if (!candidates.empty()) {
      // Triangles around a vertex are often compared one after another. If they are on one patch, only the nearest stays a
      // candidate.
      Tie &last = candidates.back();
      if (last.point == point && rule.are_of_one_patch(last.triangle, other)) {
        if (is_closer(other.distance_sq, other.triangle, last.triangle)) last.triangle = other;
        return;
      }
    }
    candidates.push_back({point, other});
  }

  // Keeps only the candidates that are ties, after all points are decided. closest_to(point) returns the closest triangle, or the
  // position -1 if there is none. node_of(point) returns the node.
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
