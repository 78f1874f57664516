// SPDX-License-Identifier: Apache-2.0
// Measures the distance of a point to the surface without triangles (paper, 4.1), for comparison.
// In: a point, a limit. Out: the closest point that the method finds, with its patch, u and v.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "paper_distances/placed_patches.hpp"

namespace riis {

struct ClosestOnPatches {
  double distance_sq = std::numeric_limits<double>::infinity();
  std::int64_t patch = -1;  // position among the placed patches; -1 for none
  double u = 0, v = 0;
  Vec3 point{0, 0, 0};
};

class PatchDistance {
 public:
  virtual ~PatchDistance() = default;

  // Returns the closest point that the method finds, if its distance from p is at most limit (>= 0, may be infinite).
  // Otherwise patch is -1. A result within the limit has the same bits for every limit. Several threads may call this function at
  // once.
  virtual ClosestOnPatches closest(Vec3 p, double limit) const = 0;

  // Returns false only if the surface certainly has no point within the limit of p.
  virtual bool may_be_within(Vec3 p, double limit) const = 0;

  // Returns true if the method measures the distance to the same set of points for every p. If so, the results for two points
  // differ by at most the distance between the two points.
  virtual bool is_of_fixed_points() const = 0;

  virtual const char *name() const = 0;

  const PlacedPatches &patches() const { return patches_; }

 protected:
  explicit PatchDistance(PlacedPatches patches) : patches_(std::move(patches)) {}

  PlacedPatches patches_;
};

struct DistanceRequest {
  std::int32_t method;  // RIIS_MEASURE_SAMPLING or RIIS_MEASURE_MINIMIZATION
  double max_error;     // measure_tolerance * half_thickness, in mesh units
};

// Makes the method that a surface's options choose. Fails with RIIS_LIMIT_EXCEEDED if it would need too many patches or
// samples.
std::unique_ptr<const PatchDistance> make_distance(const PatchSet &set, const DistanceRequest &request,
                                                   const Placement &placement, bool flip_normals);

}  // namespace riis
