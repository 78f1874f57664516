// SPDX-License-Identifier: Apache-2.0
// Makes points whose distance to the smooth surface is known. Some of the points lie on the surface, and the others are moved
// away from the surface along its normal. The inputs are patches, the number of points and a seed. The results are points with
// their distances, and the results of checks.
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

// The points' offsets along the normal, in half thicknesses.
inline constexpr std::array<double, 6> offsets{-1, -0.5, -0.1, 0.1, 0.5, 1};
// An offset is at most this fraction of the radius of curvature.
inline constexpr double largest_share_of_radius = 0.5;

struct TruthRequest {
  std::size_t n_points;
  std::uint64_t seed;
  double fine_tolerance;  // tolerance of the triangles that check the distances
};

struct GroundTruth {
  TruePoints on_surface;  // evenly by area; u and v at least SmoothSurface::step away from a patch's sides
  // These points are the points of on_surface, moved by every offset in turn. The next two fields count the points that are left
  // out.
  TruePoints off_surface;
  std::int64_t n_curved;  // points whose radius of curvature is too small for the offset
  std::int64_t n_nearer;  // points to which another part of the surface is nearer than the foot
  std::int64_t n_fine_triangles;
  // fine_error and most_from_fine are in half thicknesses. Every true distance was compared with the distance to triangles, which
  // are within fine_error of the smooth surface. All true distances are therefore right within twice fine_error. (Near a point's
  // foot they are right up to rounding, because the foot is the only minimum there.)
  double fine_error;
  double most_from_fine;  // the largest difference between a true distance and the distance to the fine triangles
};

// Throws std::logic_error if the true distances contradict the fine triangles.
GroundTruth make_ground_truth(const PatchSet &patches, const TruthRequest &request);

}  // namespace riis::accuracy
