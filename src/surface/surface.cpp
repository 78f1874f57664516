// SPDX-License-Identifier: Apache-2.0
#include "surface/surface.hpp"

#include <utility>

#include "distance/point_triangle.hpp"
#include "parallel/parallel_for.hpp"

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

Surface::Surface(TriangleSet triangles, double half_thickness, std::unique_ptr<const PatchDistance> other_distance,
                 double triangle_error)
    : triangles_(std::move(triangles)),
      scene_(triangles_, triangles_.n_triangles() > 8192 ? default_thread_count() : 1),
      half_thickness_(half_thickness),
      area_(area_of(triangles_)),
      other_distance_(std::move(other_distance)),
      triangle_error_(triangle_error) {}

const Pseudonormals &Surface::pseudonormals() const {
  if (const Pseudonormals *made = pseudonormals_.load(std::memory_order_acquire)) return *made;
  const std::lock_guard<std::mutex> lock(pseudonormals_mutex_);
  if (!pseudonormals_owner_) {
    pseudonormals_owner_ = std::make_unique<const Pseudonormals>(triangles_);
    pseudonormals_.store(pseudonormals_owner_.get(), std::memory_order_release);
  }
  return *pseudonormals_owner_;
}

int Surface::side(Vec3 p, std::size_t triangle, const PointOnTriangle &closest) const {
  const double height = dot(p - closest.point, pseudonormals().at(triangle, closest.barycentric));
  return (height > 0) - (height < 0);
}

}  // namespace riis
