// SPDX-License-Identifier: Apache-2.0
// Triangles in an Embree scene, which answers queries for closest points. Only this file and its .cpp use Embree. The closest
// triangle is the one that a loop over all triangles with the decision kernel would find.
//
// Embree works in single precision, and is used only to rule out triangles. Coordinates are recentred and scaled by a power of
// two to the size of the surface. Boxes are rounded outwards, and radii are increased by more than Embree's rounding. Double
// precision decides between the remaining triangles.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/array_view.hpp"
#include "geometry/point_triangle.hpp"
#include "scene/triangle_groups.hpp"
#include "triangulate/triangle_set.hpp"

namespace riis {

// Ties of a point are triangles that are as near to the point as its closest triangle (docs/theory/marks.md, "Equally near
// leaflets"). They belong to other leaflets than the closest triangle, or to other patches of the same leaflet. Only velocities
// need ties.
// The ties of a point do not depend on the order in which a search compares triangles.

struct TieRule {
  const std::int32_t *leaflet_id = nullptr, *patch_id = nullptr;  // for each triangle; null if ties are not wanted
  // Two distances count as equal if they differ by at most of_leaflets, for two leaflets, or of_patches, for two patches of one
  // leaflet.
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
  std::int64_t point;  // a number that the search gives the query point; in the result, the node
  ClosestTriangle triangle;
};

// The ties that one thread finds during a search. For each tied patch, the lists have the closest triangle of the patch, and
// perhaps farther ones.
struct Ties {
  TieRule rule;
  std::vector<Tie> candidates;  // ties of points that may still get nearer triangles
  std::vector<Tie> found;       // ties of nodes

  // Compares two triangles near a point. `closest` is the nearest triangle so far. If `other` may be a tie, keeps it as a
  // candidate. A triangle on the same patch as `closest` is not kept. If a nearer triangle on another patch is found later,
  // `closest` itself becomes the candidate of its patch.
  void compare(std::int64_t point, const ClosestTriangle &closest, const ClosestTriangle &other) {
    if (other.triangle < 0 || !rule.is_tie(closest, other)) return;
    if (!candidates.empty()) {
      // Triangles around a vertex are often compared one after another. Of several candidates on one patch, only the nearest
      // stays a candidate.
      Tie &last = candidates.back();
      if (last.point == point && rule.are_of_one_patch(last.triangle, other)) {
        if (is_closer(other.distance_sq, other.triangle, last.triangle)) last.triangle = other;
        return;
      }
    }
    candidates.push_back({point, other});
  }

  // After the search has decided all points, keeps only the candidates that are ties. The function closest_to(point) returns the
  // closest triangle, or a triangle with the position -1 if there is none. The function node_of(point) returns the node.
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

class TriangleScene {
 public:
  TriangleScene();
  ~TriangleScene();
  TriangleScene(const TriangleScene &) = delete;
  TriangleScene &operator=(const TriangleScene &) = delete;

  // Makes the groups from a copy of the corners, so the set need not be kept. A later call, for triangles that have moved, reuses
  // the memory. After a failure, the scene can only be destroyed. The first query builds Embree's tree with n_threads threads.
  // The tree is not built earlier, because a search over clusters never needs it. A query fails with RIIS_INTERNAL_ERROR or
  // RIIS_OUT_OF_MEMORY if Embree reports an error. After an error, the next query tries once more.
  void make(const TriangleSet &set, int n_threads);

  // Builds Embree's tree, as the first query does. Several threads may call this function at once.
  void build_tree() const;

  // Returns the triangle closest to p. If no triangle is within the limit, the number of the returned triangle is -1. The limit
  // is at least 0, and may be infinite. The point p must be finite, with coordinates up to max_coordinate. Several threads may
  // call this function at once. If `ties` is not null, its candidates are replaced by those of p.
  ClosestTriangle closest(Vec3 p, double limit, InstructionSet instructions = best_instruction_set(),
                          Ties *ties = nullptr) const;

  // Returns false only if no triangle is within the limit of p. Compares p with the box of all triangles in double precision,
  // which takes little time.
  bool may_be_within(Vec3 p, double limit) const;

  const Bounds &bounds() const { return bounds_; }

  const TriangleGroups &groups() const;

  // Adds to `found` all groups whose bounds are within `radius` of a point, and perhaps other groups. The point and the radius
  // are in the groups' frame. The radius and the point's coordinates must be below 4e6.
  void collect_groups(const float *point, float radius, std::vector<std::int32_t> &found) const;

  // Calls visit(triangle) for all triangles that meet the segment from a to b, and perhaps for other triangles. `triangle` is a
  // position in the set. `found` is scratch memory. Coordinates must be at most max_coordinate.
  template <class Visit>
  void for_each_along(Vec3 a, Vec3 b, std::vector<std::int32_t> &found, const Visit &visit) const {
    found.clear();
    collect_along(a, b, found);
    const TriangleGroups &in = groups();
    for (const std::int32_t group : found)
      for (int i = 0; i < view(in.bounds)[group].n; ++i) visit(view(in.bounds)[group].triangle[i]);
  }

  // Bounds that part of the error of a computed distance which comes from rounding the triangles' coordinates. Two other parts,
  // which are proportional to the distance and to |p|, are not included.
  double rounding() const { return rounding_; }

  struct Implementation;  // public, because Embree's callbacks use this type

 private:
  template <bool keeps_ties>
  ClosestTriangle find_closest(Vec3 p, double limit, InstructionSet instructions, Ties *ties) const;

  // Adds all groups with a triangle that meets the segment, and perhaps other groups.
  void collect_along(Vec3 a, Vec3 b, std::vector<std::int32_t> &found) const;

  Bounds bounds_{};
  double rounding_ = 0;  // the value that rounding() returns
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace riis
