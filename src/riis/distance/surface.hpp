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
#include "surface/orifice.hpp"
#include "surface/pseudonormals.hpp"
#include "surface/triangle_scene.hpp"
#include "surface/triangle_set.hpp"
#include "surface/velocity_bound.hpp"

namespace riis {

class Surface {
 public:
  // Makes the surface, again after it moved, and reuses its memory. The surface is of no use after a failure.
  void make(TriangleSet triangles, double half_thickness, int n_threads);
  // Moves the triangles out, so that the next ones can reuse their memory.
  TriangleSet take_triangles() { return std::move(triangles_); }
  // Sets another method for distances. Without it, distances are to the triangles.
  void measure_by(std::unique_ptr<const PatchDistance> other_distance, double triangle_error);

  // Takes the frame of the valve that the triangles come from. A surface from arrays has none.
  void is_of_valve(const ValveFrame &frame) { frame_.emplace(frame); }
  const std::optional<ValveFrame> &frame() const { return frame_; }

  // Takes the states that the velocities come from.
  void moved_between(TwoStates states) { states_.emplace(std::move(states)); }

  const TriangleSet &triangles() const { return triangles_; }
  const TriangleScene &scene() const { return scene_; }
  double half_thickness() const { return half_thickness_; }
  // Returns the area of all triangles. The first call computes it. Several threads may call this function at once.
  double area() const;

  // Bounds how far a velocity is from that of the smooth valve at the same patch, u and v; 0 without a motion of patches. The
  // first call computes it. Several threads may call this function at once.
  double velocity_error_bound() const;

  // Returns the method that measures distances. Null means the triangles' scene.
  const PatchDistance *other_distance() const { return other_distance_.get(); }
  // The distance to the triangles exceeds the distance to any point of the method's patches by at most this.
  double triangle_error() const { return triangle_error_; }

  // Returns the normals for sides and rims. The first call makes them. Several threads may call this function at once.
  const Pseudonormals &pseudonormals() const {
    const Pseudonormals *made = pseudonormals_.load(std::memory_order_acquire);
    return made ? *made : make_pseudonormals();
  }

 private:
  static constexpr double not_known = -1;

  const Pseudonormals &make_pseudonormals() const;

  TriangleSet triangles_;
  TriangleScene scene_;
  double half_thickness_ = 0;
  // Marking never needs the area. Any thread that computes it gets the same bits.
  mutable std::atomic<double> area_{not_known};
  std::optional<ValveFrame> frame_;
  std::optional<TwoStates> states_;
  mutable std::atomic<double> velocity_error_bound_{not_known};
  std::unique_ptr<const PatchDistance> other_distance_;
  double triangle_error_ = 0;
  // They are made at the first query of a side: marking never needs them.
  mutable std::mutex pseudonormals_mutex_;
  mutable std::optional<const Pseudonormals> pseudonormals_owner_;
  mutable std::atomic<const Pseudonormals *> pseudonormals_{nullptr};
};

}  // namespace riis
