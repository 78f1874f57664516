// SPDX-License-Identifier: Apache-2.0
// A surface that can be asked: triangles, their scene, the half thickness, and another method for distances where one is wanted.
// In: triangles. Out: closest triangles, sides.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <utility>

#include "distance/patch_distance.hpp"
#include "surface/pseudonormals.hpp"
#include "surface/triangle_scene.hpp"
#include "surface/triangle_set.hpp"

namespace riis {

class Surface {
 public:
  // Again for a surface that moved, with the memory of what was there. Of no use if it fails.
  void make(TriangleSet triangles, double half_thickness, int n_threads);
  // For their memory.
  TriangleSet take_triangles() { return std::move(triangles_); }
  // Distances are those of the triangles, unless there is another method.
  void measure_by(std::unique_ptr<const PatchDistance> other_distance, double triangle_error);

  const TriangleSet &triangles() const { return triangles_; }
  const TriangleScene &scene() const { return scene_; }
  double half_thickness() const { return half_thickness_; }
  double area() const { return area_; }

  // The method that distances are measured by; null: the triangles' scene.
  const PatchDistance *other_distance() const { return other_distance_.get(); }
  // The distance to the triangles is at most this above the distance to any point of the patches that the method works on.
  double triangle_error() const { return triangle_error_; }

  // +1, -1 or 0: the side of the surface that p is on, seen from its closest point, which lies on that triangle. May be asked by
  // several threads at once.
  int side(Vec3 p, std::size_t triangle, const PointOnTriangle &closest) const;

  // Makes what sides need, once; otherwise the first side does.
  void prepare_sides() const { pseudonormals(); }

 private:
  const Pseudonormals &pseudonormals() const;

  TriangleSet triangles_;
  TriangleScene scene_;
  double half_thickness_ = 0;
  double area_ = 0;
  std::unique_ptr<const PatchDistance> other_distance_;
  double triangle_error_ = 0;
  // Made when a side is first asked for: marking never needs it.
  mutable std::mutex pseudonormals_mutex_;
  mutable std::unique_ptr<const Pseudonormals> pseudonormals_owner_;
  mutable std::atomic<const Pseudonormals *> pseudonormals_{nullptr};
};

}  // namespace riis
