// SPDX-License-Identifier: Apache-2.0
#include "scene/surface.hpp"

#include <algorithm>
#include <utility>

#include "common/array_view.hpp"
#include "geometry/point_triangle.hpp"

namespace riis {
namespace {

// Sums one number for each triangle. The sum is made in blocks, because this loses fewer digits to rounding.
template <class OfTriangle>
double sum_over_triangles(std::int64_t n, const OfTriangle &of_triangle) {
  constexpr std::int64_t triangles_per_block = 4096;
  double sum = 0;
  for (std::int64_t first = 0; first < n; first += triangles_per_block) {
    double of_block = 0;
    for (std::int64_t i = first; i < std::min(n, first + triangles_per_block); ++i) of_block += of_triangle(i);
    sum += of_block;
  }
  return sum;
}

// Returns the derivative of the area of a triangle whose corners move at these rates.
double area_rate_of(const TriangleSet &set, const double *rates, std::int64_t triangle) {
  const auto [a, b, c] = set.corners(triangle);
  const std::int64_t *const id = set.vertex_id.data() + 3 * triangle;
  const auto rate = [&](int k) { return Vec3{rates[3 * id[k]], rates[3 * id[k] + 1], rates[3 * id[k] + 2]}; };
  const Vec3 ab = b - a, ac = c - a, normal = cross(ab, ac), of_a = rate(0);
  const double twice_area = length(normal);
  if (!(twice_area > 0)) return 0;
  return 0.5 / twice_area * dot(normal, cross(rate(1) - of_a, ac) + cross(ab, rate(2) - of_a));
}

// Collects the ids of the leaflets. The triangles of a valve are ordered by leaflet, so only few ids have to be sorted.
void collect_leaflets(const TriangleSet &set, std::vector<std::int32_t> &ids) {
  ids.clear();
  for (const std::int32_t id : set.leaflet_id)
    if (ids.empty() || ids.back() != id) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

void Surface::make(TriangleSet triangles, const Band &band, int n_threads) {
  triangles_ = std::move(triangles);
  band_ = band;
  collect_leaflets(triangles_, leaflet_ids_);
  attachment_.forget() = {};
  leaflets_.forget() = {};
  area_.store(not_known, std::memory_order_relaxed);
  pseudonormals_.forget().reset();
  other_distance_.reset();
  source_valve_.reset();
  patches_.reset();
  n_directions_ = 0;
  scene_.make(triangles_, n_threads);
}

void Surface::measure_by(std::unique_ptr<const PatchDistance> other_distance, double triangle_error) {
  other_distance_ = std::move(other_distance);
  triangle_error_ = triangle_error;
}

double Surface::area() const {
  double area = area_.load(std::memory_order_relaxed);
  if (area == not_known) {
    area = sum_over_triangles(triangles_.n_triangles(), [&](std::int64_t i) { return triangles_.area(i); });
    area_.store(area, std::memory_order_relaxed);
  }
  return area;
}

double Surface::area_rate(std::int64_t direction) const {
  const double *const rates_here = rates(direction).data();
  return sum_over_triangles(triangles_.n_triangles(),
                            [&](std::int64_t i) { return area_rate_of(triangles_, rates_here, i); });
}

void Surface::add_direction(const Direction &direction, int n_threads) {
  const auto n = static_cast<std::size_t>(n_directions_);
  if (rates_.size() == n) rates_.emplace_back();
  make_vertex_rates(*patches(), triangles_.grids, direction, n_threads, rates_[n]);
  ++n_directions_;
}

}  // namespace riis
