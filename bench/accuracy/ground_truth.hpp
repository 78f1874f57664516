// SPDX-License-Identifier: Apache-2.0
// Points whose distance to the smooth surface is known: points on it, and points off it along its normal.
// In: patches, the number of points, a seed. Out: points with their distances, and the results of checks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "valve/patches.hpp"

namespace riis::accuracy {

struct TruePoints {
  std::vector<double> xyz;       // (3, n)
  std::vector<double> distance;  // the true distance, cm

  std::size_t n() const { return distance.size(); }
  const double *point(std::size_t i) const { return xyz.data() + 3 * i; }
};

// The points' offsets from the surface, in half thicknesses.
inline constexpr std::array<double, 6> offsets{-1, -0.5, -0.1, 0.1, 0.5, 1};
// An offset is at most this share of the curvature radius.
inline constexpr double largest_share_of_radius = 0.5;

struct TruthRequest {
  std::size_t n_points;
  std::uint64_t seed;
  double fine_tolerance;  // of the triangles that check the distances
};

struct GroundTruth {
  TruePoints on_surface;   // evenly by area; u and v at least SmoothSurface::step away from a patch's sides
  TruePoints off_surface;  // one for each of them, with offsets in turn; two kinds are left out:
  std::int64_t n_curved;   // the curvature radius is too small for the offset
  std::int64_t n_nearer;   // another part of the surface is nearer than the foot
  std::int64_t n_fine_triangles;
  // Both are in half thicknesses. Every true distance was compared with the distance to triangles within fine_error of the smooth
  // surface. So all true distances are right within twice fine_error. (They are right up to rounding: an offset point's foot is
  // the only minimum near itself.)
  double fine_error;
  double most_from_fine;  // the largest difference between a true distance and the distance to these triangles
};

// Throws std::logic_error if true distances and fine triangles contradict each other.
GroundTruth make_ground_truth(const PatchSet &patches, const TruthRequest &request);

}  // namespace riis::accuracy
