// SPDX-License-Identifier: Apache-2.0
// A surface that can be asked: triangles, their scene, the half thickness.
// In: triangles. Out: closest points in full.
#pragma once

#include <riis/riis.h>

#include <atomic>
#include <memory>
#include <mutex>

#include "surface/pseudonormals.hpp"
#include "surface/triangle_scene.hpp"
#include "surface/triangle_set.hpp"

namespace riis {

class Surface {
 public:
  Surface(TriangleSet triangles, double half_thickness);

  const TriangleSet &triangles() const { return triangles_; }
  const TriangleScene &scene() const { return scene_; }
  double half_thickness() const { return half_thickness_; }
  double area() const { return area_; }

  // All of riis_closest for the triangle that a query found.
  riis_closest describe(Vec3 p, const ClosestTriangle &closest) const;

 private:
  const Pseudonormals &pseudonormals() const;

  TriangleSet triangles_;
  TriangleScene scene_;
  double half_thickness_;
  double area_;
  // Made when a side is first asked for: marking never needs it.
  mutable std::mutex pseudonormals_mutex_;
  mutable std::unique_ptr<const Pseudonormals> pseudonormals_owner_;
  mutable std::atomic<const Pseudonormals *> pseudonormals_{nullptr};
};

}  // namespace riis
