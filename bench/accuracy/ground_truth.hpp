// SPDX-License-Identifier: Apache-2.0
// Points whose distance to the smooth surface is known: points of it, and points off it along its normal.
// In: patches, how many points, a seed. Out: points with their distances, and how that was checked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "valve/patches.hpp"

namespace riis::accuracy {

struct TruePoints {
  std::vector<double> xyz;       // (3, n)
  std::vector<double> distance;  // the true one, cm

  std::size_t n() const { return distance.size(); }
  const double *point(std::size_t i) const { return xyz.data() + 3 * i; }
};

// In half thicknesses.
inline constexpr std::array<double, 6> offsets{-1, -0.5, -0.1, 0.1, 0.5, 1};
// An offset is at most this share of the curvature radius.
inline constexpr double largest_share_of_radius = 0.5;

struct TruthRequest {
  std::size_t n_points;
  std::uint64_t seed;
  double fine_tolerance;  // of the triangles that the distances are checked with
};

struct GroundTruth {
  TruePoints on_surface;   // evenly by area; u and v at least SmoothSurface::step away from a patch's sides
  TruePoints off_surface;  // one for each of them, offsets in turn, but for those that are left out:
  std::int64_t n_curved;   // the curvature radius is too small for the offset
  std::int64_t n_nearer;   // another part of the surface is nearer than the foot
  std::int64_t n_fine_triangles;
  // Half thicknesses. Triangles that are within fine_error of the smooth surface have been asked for every point; so all true
  // distances are within twice that. (They are right to rounding: an offset point's foot is the only minimum near itself.)
  double fine_error;
  double most_from_fine;  // the largest difference between a true distance and that to these triangles
};

// Throws std::logic_error where true distances and fine triangles contradict each other.
GroundTruth make_ground_truth(const PatchSet &patches, const TruthRequest &request);

}  // namespace riis::accuracy
