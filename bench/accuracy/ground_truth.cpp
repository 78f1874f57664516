// SPDX-License-Identifier: Apache-2.0
#include "accuracy/ground_truth.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include "accuracy/methods.hpp"
#include "accuracy/smooth_surface.hpp"
#include "geometry/placement.hpp"
#include "triangulate/triangulate.hpp"

namespace riis::accuracy {
namespace {

struct Place {
  std::size_t image;
  double u, v;
};

// Chooses random points evenly by area. The area is measured on triangles that follow the surface within a tolerance. The points
// are therefore evenly spread only within this tolerance.
class Places {
 public:
  Places(const PatchSet &patches, const SmoothSurface &smooth)
      : smooth_(smooth),
        triangles_(
            triangulate_adapted(patches, {0.02 * half_thickness, {1, rotation_xyz({0, 0, 0}), {0, 0, 0}}, false, 1})) {
    double sum = 0;
    for (std::int64_t i = 0; i < triangles_.n_triangles(); ++i) {
      const auto [a, b, c] = triangles_.corners(i);
      areas_.push_back(sum += 0.5 * length(cross(b - a, c - a)));
    }
  }

  template <class Random>
  Place draw(Random &random) const {
    std::uniform_real_distribution<double> share(0, 1);
    const double area = share(random) * areas_.back();
    const auto triangle =
        std::min(static_cast<std::size_t>(std::upper_bound(areas_.begin(), areas_.end(), area) - areas_.begin()),
                 areas_.size() - 1);
    double b = share(random), c = share(random);
    if (b + c > 1) b = 1 - b, c = 1 - c;
    const std::int64_t *vertex = triangles_.vertex_id.data() + 3 * triangle;
    const auto mixed = [&](std::int64_t k) {
      const double *uv = triangles_.uv.data() + k;
      const double at = (1 - b - c) * uv[2 * vertex[0]] + b * uv[2 * vertex[1]] + c * uv[2 * vertex[2]];
      return std::clamp(at, SmoothSurface::step, 1 - SmoothSurface::step);
    };
    return {smooth_.image_of(triangles_.patch_id[triangle]), mixed(0), mixed(1)};
  }

 private:
  const SmoothSurface &smooth_;
  TriangleSet triangles_;
  std::vector<double> areas_;  // sums of the areas up to each triangle
};

void add(TruePoints &points, Vec3 p, double distance) {
  points.xyz.insert(points.xyz.end(), {p.x, p.y, p.z});
  points.distance.push_back(distance);
}

double norm(const double *p, Vec3 q) { return length(q - Vec3{p[0], p[1], p[2]}); }

}  // namespace

GroundTruth make_ground_truth(const PatchSet &patches, const TruthRequest &request) {
  const SmoothSurface smooth(patches);
  const Places places(patches, smooth);
  const MeasuredSurface fine(patches, RIIS_MEASURE_TRIANGLES, request.fine_tolerance);
  GroundTruth truth{{}, {}, 0, 0, fine.size(), request.fine_tolerance, 0};
  const double error = request.fine_tolerance * half_thickness;
  const auto check = [&](double fine_distance, double true_distance) {
    const double off = std::abs(fine_distance - true_distance);
    if (!(off <= error * (1 + 1e-6)))
      throw std::logic_error("a point at " + std::to_string(true_distance) + " from the smooth surface is off by " +
                             std::to_string(off / error) + " times the bound of the triangles that it is checked with");
    truth.most_from_fine = std::max(truth.most_from_fine, off / half_thickness);
  };
  std::mt19937_64 random(request.seed);
  for (std::size_t i = 0; i < request.n_points; ++i) {
    const Place place = places.draw(random);
    const SurfacePoint foot = smooth.describe(place.image, place.u, place.v);
    add(truth.on_surface, foot.point, 0);
    check(fine.distance(truth.on_surface.point(i)), 0);
    const double offset = offsets[i % offsets.size()] * half_thickness, height = std::abs(offset);
    if (!(height * foot.curvature <= largest_share_of_radius)) {
      ++truth.n_curved;
      continue;
    }
    const Vec3 p = foot.point + offset * foot.normal;
    const double xyz[3] = {p.x, p.y, p.z};
    const riis_closest closest = fine.closest(xyz);
    // The point p was moved by `height` from its foot, a point of the surface at which the curvature is bounded. A point of the
    // surface near the foot, at the distance r from the foot, is therefore at least sqrt(height^2 + r^2 / 2) away from p. A
    // triangle that is nearer to p belongs to another part of the surface.
    const double reach = 3 * std::sqrt(error * (height + error)) + error;
    if (closest.distance < height - error || norm(closest.point, foot.point) > reach) {
      ++truth.n_nearer;
      continue;
    }
    check(closest.distance, height);
    add(truth.off_surface, p, height);
  }
  return truth;
}

}  // namespace riis::accuracy
