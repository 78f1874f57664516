// SPDX-License-Identifier: Apache-2.0
#include "surface/surface.hpp"

#include <utility>

#include "distance/point_triangle.hpp"

namespace riis {
namespace {

double area_of(const TriangleSet &set) {
  double area = 0;
  for (std::size_t i = 0; i < set.n_triangles(); ++i) {
    const auto [a, b, c] = set.corners(i);
    area += 0.5 * length(cross(b - a, c - a));
  }
  return area;
}

}  // namespace

Surface::Surface(TriangleSet triangles, double half_thickness)
    : triangles_(std::move(triangles)),
      scene_(triangles_),
      half_thickness_(half_thickness),
      area_(area_of(triangles_)) {}

const Pseudonormals &Surface::pseudonormals() const {
  if (const Pseudonormals *made = pseudonormals_.load(std::memory_order_acquire)) return *made;
  const std::lock_guard<std::mutex> lock(pseudonormals_mutex_);
  if (!pseudonormals_owner_) {
    pseudonormals_owner_ = std::make_unique<const Pseudonormals>(triangles_);
    pseudonormals_.store(pseudonormals_owner_.get(), std::memory_order_release);
  }
  return *pseudonormals_owner_;
}

riis_closest Surface::describe(Vec3 p, const ClosestTriangle &closest) const {
  const auto i = static_cast<std::size_t>(closest.triangle);
  const std::array<Vec3, 3> corners = triangles_.corners(i);
  const PointOnTriangle on = closest_point_on_triangle(p, corners[0], corners[1], corners[2]);
  const Vec3 normal = triangle_normal(corners);
  const double height = dot(p - on.point, pseudonormals().at(i, on.barycentric));
  return {std::sqrt(on.distance_sq),
          {on.point.x, on.point.y, on.point.z},
          {on.barycentric[0], on.barycentric[1], on.barycentric[2]},
          {normal.x, normal.y, normal.z},
          triangles_.triangle_id[i],
          triangles_.leaflet_id[i],
          (height > 0) - (height < 0)};
}

}  // namespace riis
