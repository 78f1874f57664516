// SPDX-License-Identifier: Apache-2.0
// Triangles in an Embree scene, asked for closest points. The only file, with its .cpp, that names Embree.
// In: a triangle set, a point, a limit. Out: the closest triangle, equal to the brute force over the same kernel.
//
// Embree works in single precision. Here it only culls: coordinates are recentred and scaled by a power of two to the
// size of the surface, boxes are rounded outwards, radii inflated by more than Embree's rounding; every candidate is
// decided in double.
#pragma once

#include <cstdint>
#include <memory>

#include "base/array_view.hpp"
#include "geometry/point_triangle.hpp"
#include "surface/triangle_groups.hpp"
#include "surface/triangle_set.hpp"

namespace riis {

class TriangleScene {
 public:
  TriangleScene();
  ~TriangleScene();
  TriangleScene(const TriangleScene &) = delete;
  TriangleScene &operator=(const TriangleScene &) = delete;

  // Keeps a copy of the corners; the set may go. Again for triangles that moved, with the memory of those before. Fails with
  // RIIS_INTERNAL_ERROR or RIIS_OUT_OF_MEMORY as Embree says, and is of no use then.
  void make(const TriangleSet &set, int n_threads);

  // The closest triangle to p, if its distance is at most limit (>= 0, may be infinite); triangle -1 if there is none.
  // p is finite with coordinates up to max_coordinate. May be called by several threads at once.
  ClosestTriangle closest(Vec3 p, double limit, InstructionSet instructions = best_instruction_set()) const;

  // False only where no triangle is within the limit of p: a cheap question to the bounds, in double.
  bool may_be_within(Vec3 p, double limit) const;

  const Bounds &bounds() const { return bounds_; }

  const TriangleGroups &groups() const;

  // Adds to `found` at least the groups whose bounds are within a radius of a point, both in the groups' frame. The radius and
  // the point's coordinates are below 4e6.
  void collect_groups(const float *point, float radius, std::vector<std::int32_t> &found) const;

  // Calls visit(triangle) for triangles, by their positions in the set, among which are all that meet the segment from a to b.
  // `found` is room. Coordinates are up to max_coordinate.
  template <class Visit>
  void for_each_along(Vec3 a, Vec3 b, std::vector<std::int32_t> &found, const Visit &visit) const {
    found.clear();
    collect_along(a, b, found);
    const TriangleGroups &in = groups();
    for (const std::int32_t group : found)
      for (int i = 0; i < view(in.bounds)[group].n; ++i) visit(view(in.bounds)[group].triangle[i]);
  }

  // How far a distance, as it is computed, may be off, beyond what is in proportion to it and to p: the triangles' coordinates round.
  double rounding() const { return rounding_; }

  struct Implementation;  // public for Embree's callbacks

 private:
  // Adds at least the groups that have a triangle which meets the segment.
  void collect_along(Vec3 a, Vec3 b, std::vector<std::int32_t> &found) const;

  Bounds bounds_{};
  double rounding_ = 0;  // of any distance to any point of the surface, beyond what is relative to the distance
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace riis
