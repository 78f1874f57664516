// SPDX-License-Identifier: Apache-2.0
// A surface for queries: triangles, their scene, the half thickness, and another method for distances if one is wanted.
// In: triangles. Out: closest triangles, sides.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "distance/patch_distance.hpp"
#include "surface/pseudonormals.hpp"
#include "surface/triangle_scene.hpp"
#include "surface/triangle_set.hpp"

namespace riis {

class Surface {
 public:
  // Makes the surface, again after it moved, and reuses its memory. The surface is of no use after a failure.
  void make(TriangleSet triangles, double half_thickness, int n_threads);
  // Gives the triangles away, for their memory.
  TriangleSet take_triangles() { return std::move(triangles_); }
  // Sets another method for distances. Without it, distances are to the triangles.
  void measure_by(std::unique_ptr<const PatchDistance> other_distance, double triangle_error);

  const TriangleSet &triangles() const { return triangles_; }
  const TriangleScene &scene() const { return scene_; }
  double half_thickness() const { return half_thickness_; }
  double area() const { return area_; }

  // Returns the method that measures distances. Null means the triangles' scene.
  const PatchDistance *other_distance() const { return other_distance_.get(); }
  // The distance to the triangles exceeds the distance to any point of the method's patches by at most this.
  double triangle_error() const { return triangle_error_; }

  // Returns +1, -1 or 0: the side of the surface that p is on, seen from its closest point, which lies on that
  // triangle. Several threads may call this function at once.
  int side(Vec3 p, std::int64_t triangle, const PointOnTriangle &closest) const;

  // Returns whether the closest point of a triangle lies on the rim of the surface. Several threads may call it at once.
  bool is_on_rim(std::int64_t triangle, const PointOnTriangle &closest) const {
    return pseudonormals().is_on_rim(triangle, closest.barycentric);
  }

  // Returns the unit normal of a triangle, which it has made for the sides.
  Vec3 normal(std::int64_t triangle) const { return pseudonormals().of_face(triangle); }

  // Makes the normals for sides, once. Otherwise the first query of a side makes them.
  void prepare_sides() const { pseudonormals(); }

 private:
  const Pseudonormals &pseudonormals() const {
    const Pseudonormals *made = pseudonormals_.load(std::memory_order_acquire);
    return made ? *made : make_pseudonormals();
  }
  const Pseudonormals &make_pseudonormals() const;

  TriangleSet triangles_;
  TriangleScene scene_;
  double half_thickness_ = 0;
  double area_ = 0;
  std::unique_ptr<const PatchDistance> other_distance_;
  double triangle_error_ = 0;
  // They are made at the first query of a side: marking never needs them.
  mutable std::mutex pseudonormals_mutex_;
  mutable std::optional<const Pseudonormals> pseudonormals_owner_;
  mutable std::atomic<const Pseudonormals *> pseudonormals_{nullptr};
};

}  // namespace riis
