// SPDX-License-Identifier: Apache-2.0
#include "paper_distances/placed_patches.hpp"

#include <algorithm>
#include <cmath>

#include "triangulate/grids.hpp"

namespace riis {
Vec3 PlacedPatch::normal_at(double u, double v) const {
  const std::size_t i = interval_of(grid.u, u), j = interval_of(grid.v, v);
  const double s = (u - grid.u[i]) / (grid.u[i + 1] - grid.u[i]), t = (v - grid.v[j]) / (grid.v[j + 1] - grid.v[j]);
  const Vec3 p00 = grid.point(i, j), p10 = grid.point(i + 1, j);
  const Vec3 p01 = grid.point(i, j + 1), p11 = grid.point(i + 1, j + 1);
  const Vec3 along_u = mix(p10 - p00, p11 - p01, t), along_v = mix(p01 - p00, p11 - p10, s);
  const double size_u = length(along_u), size_v = length(along_v);
  if (!(size_u > 0 && size_v > 0)) return {0, 0, 0};
  const Vec3 across = cross((1 / size_u) * along_u, (1 / size_v) * along_v);
  const double size = length(across);
  // A vector shorter than this limit consists of rounding errors only. has_zero_area uses the same limit.
  if (!(size > 1e-12)) return {0, 0, 0};
  return ((is_turned_over ? -1 : 1) / size) * across;
}

PlacedPatches::PlacedPatches(const PatchSet &set, double max_error, const Placement &placement, bool flip_normals) {
  std::size_t number = 0;
  for (const QuadGrid &grid : make_grids(set, error_left(set, max_error))) {
    const double error = *std::max_element(grid.errors.begin(), grid.errors.end()) + set.deviation;
    for (const PatchImage &image : set.patches[number].images) {
      QuadGrid placed{grid.u, grid.v, {}, {}};
      placed.points.reserve(grid.points.size());
      for (const Vec3 &p : grid.points) placed.points.push_back(place(placement, place(image, p)));
      patches.push_back({std::move(placed), image.leaflet_id, image.patch_id, points_upstream(image) != flip_normals});
      errors.push_back(error * placement.scale);
    }
    ++number;
  }
}

double PlacedPatches::largest_error() const { return *std::max_element(errors.begin(), errors.end()); }

Speeds largest_speeds(const QuadGrid &grid) {
  Speeds largest{0, 0};
  for_each_derivatives(grid, [&](const auto &along_u, const auto &along_v) {
    for (const Vec3 &a : along_u) largest.u = std::max(largest.u, length(a));
    for (const Vec3 &a : along_v) largest.v = std::max(largest.v, length(a));
  });
  return largest;
}

Bounds bounds_of(const QuadGrid &grid) {
  Bounds box;
  for (const Vec3 &p : grid.points) box.add(p);
  return box;
}

double distance_sq_to(const Bounds &box, Vec3 p) {
  const auto outside = [](double x, double lower, double upper) { return std::max({lower - x, x - upper, 0.0}); };
  const Vec3 gap{outside(p.x, box.lower.x, box.upper.x), outside(p.y, box.lower.y, box.upper.y),
                 outside(p.z, box.lower.z, box.upper.z)};
  return dot(gap, gap);
}

}  // namespace riis
