// SPDX-License-Identifier: Apache-2.0
#include "distance/surface.hpp"

#include <numeric>
#include <utility>
#include <vector>

#include "base/array_view.hpp"
#include "geometry/point_triangle.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// Sums block by block, so that the area does not depend on which thread summed which block.
double area_of(const TriangleSet &set, int n_threads) {
  const std::int64_t n = set.n_triangles();
  constexpr std::int64_t triangles_per_block = 4096;
  Vector<double> areas;
  resize(areas, (n + triangles_per_block - 1) / triangles_per_block);
  parallel_for_ranges(n, triangles_per_block, n_threads, [&](const Range &range, int) {
    double area = 0;
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      const auto [a, b, c] = set.corners(i);
      area += 0.5 * length(cross(b - a, c - a));
    }
    view(areas)[range.begin / triangles_per_block] = area;
  });
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

}  // namespace

void Surface::make(TriangleSet triangles, double half_thickness, int n_threads) {
  triangles_ = std::move(triangles);
  half_thickness_ = half_thickness;
  area_ = area_of(triangles_, n_threads);
  pseudonormals_.store(nullptr, std::memory_order_relaxed);
  pseudonormals_owner_.reset();
  other_distance_.reset();
  scene_.make(triangles_, n_threads);
}

void Surface::measure_by(std::unique_ptr<const PatchDistance> other_distance, double triangle_error) {
  other_distance_ = std::move(other_distance);
  triangle_error_ = triangle_error;
}

const Pseudonormals &Surface::make_pseudonormals() const {
  const std::lock_guard<std::mutex> lock(pseudonormals_mutex_);
  if (!pseudonormals_owner_) {
    pseudonormals_owner_.emplace(triangles_);
    pseudonormals_.store(&*pseudonormals_owner_, std::memory_order_release);
  }
  return *pseudonormals_owner_;
}

}  // namespace riis
