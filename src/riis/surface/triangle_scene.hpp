// SPDX-License-Identifier: Apache-2.0
// Triangles in an Embree scene, which answers queries for closest points. Only this file and its .cpp name Embree.
// In: a triangle set, a point, a limit. Out: the closest triangle, equal to the brute force over the same kernel.
//
// Embree works in single precision and only culls here. Coordinates are recentred and scaled by a power of two to the size of
// the surface. Boxes are rounded outwards, and radii are inflated by more than Embree's rounding. Every candidate is decided in
// double.
#pragma once

#include <cstdint>
#include <memory>

#include "common/array_view.hpp"
#include "geometry/point_triangle.hpp"
#include "surface/ties.hpp"
#include "surface/triangle_groups.hpp"
#include "surface/triangle_set.hpp"

namespace riis {

class TriangleScene {
 public:
  TriangleScene();
  ~TriangleScene();
  TriangleScene(const TriangleScene &) = delete;
  TriangleScene &operator=(const TriangleScene &) = delete;

  // Makes the scene from a copy of the corners; the set may go. A second call, for triangles that moved, uses the memory of the
  // first. Fails with RIIS_INTERNAL_ERROR or RIIS_OUT_OF_MEMORY, as Embree reports. The scene is then fit for destruction only.
  void make(const TriangleSet &set, int n_threads);

  // Returns the closest triangle to p, or triangle -1 if none is within the limit (>= 0, may be infinite). p is finite, with
  // coordinates up to max_coordinate. Several threads may call it at once. `ties`, if not null, gets candidates in place of those
  // that it had.
  ClosestTriangle closest(Vec3 p, double limit, InstructionSet instructions = best_instruction_set(),
                          Ties *ties = nullptr) const;

  // Returns false only if no triangle is within the limit of p. It compares p with the bounds, in double, which is cheap.
  bool may_be_within(Vec3 p, double limit) const;

  const Bounds &bounds() const { return bounds_; }

  const TriangleGroups &groups() const;

  // Adds to `found` at least the groups whose bounds are within a radius of a point, both in the groups' frame. The radius and
  // the point's coordinates are below 4e6.
  void collect_groups(const float *point, float radius, std::vector<std::int32_t> &found) const;

  // Calls visit(triangle) for at least all triangles that meet the segment from a to b, by their positions in the set. `found`
  // is scratch memory. Coordinates are up to max_coordinate.
  template <class Visit>
  void for_each_along(Vec3 a, Vec3 b, std::vector<std::int32_t> &found, const Visit &visit) const {
    found.clear();
    collect_along(a, b, found);
    const TriangleGroups &in = groups();
    for (const std::int32_t group : found)
      for (int i = 0; i < view(in.bounds)[group].n; ++i) visit(view(in.bounds)[group].triangle[i]);
  }

  // Bounds how far a computed distance may be off because the triangles' coordinates round. Errors in proportion to the distance
  // and to p come on top.
  double rounding() const { return rounding_; }

  struct Implementation;  // public for Embree's callbacks

 private:
  template <bool keeps_ties>
  ClosestTriangle find_closest(Vec3 p, double limit, InstructionSet instructions, Ties *ties) const;

  // Adds at least the groups that have a triangle which meets the segment.
  void collect_along(Vec3 a, Vec3 b, std::vector<std::int32_t> &found) const;

  Bounds bounds_{};
  double rounding_ = 0;  // as rounding() returns it
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace riis
