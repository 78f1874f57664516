// SPDX-License-Identifier: Apache-2.0
#include "distance/surface.hpp"

#include <algorithm>
#include <utility>

#include "common/array_view.hpp"
#include "geometry/point_triangle.hpp"

namespace riis {
namespace {

// Sums the areas block by block, which loses less to rounding.
double area_of(const TriangleSet &set) {
  const std::int64_t n = set.n_triangles();
  constexpr std::int64_t triangles_per_block = 4096;
  double area = 0;
  for (std::int64_t first = 0; first < n; first += triangles_per_block) {
    double of_block = 0;
    for (std::int64_t i = first; i < std::min(n, first + triangles_per_block); ++i) of_block += set.area(i);
    area += of_block;
  }
  return area;
}

// Collects the ids of the leaflets. In the surface of a valve, the triangles of a leaflet follow each other, so few ids are
// sorted.
void collect_leaflets(const TriangleSet &set, std::vector<std::int32_t> &ids) {
  ids.clear();
  for (const std::int32_t id : set.leaflet_id)
    if (ids.empty() || ids.back() != id) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

void Surface::make(TriangleSet triangles, double half_thickness, int n_threads) {
  triangles_ = std::move(triangles);
  half_thickness_ = half_thickness;
  collect_leaflets(triangles_, leaflet_ids_);
  attachment_.reset();
  leaflets_.reset();
  area_.store(not_known, std::memory_order_relaxed);
  pseudonormals_.store(nullptr, std::memory_order_relaxed);
  pseudonormals_owner_.reset();
  other_distance_.reset();
  frame_.reset();
  states_.reset();
  patches_.reset();
  n_directions_ = 0;
  velocity_error_bound_.store(not_known, std::memory_order_relaxed);
  scene_.make(triangles_, n_threads);
}

void Surface::measure_by(std::unique_ptr<const PatchDistance> other_distance, double triangle_error) {
  other_distance_ = std::move(other_distance);
  triangle_error_ = triangle_error;
}

double Surface::area() const {
  double area = area_.load(std::memory_order_relaxed);
  if (area == not_known) area_.store(area = area_of(triangles_), std::memory_order_relaxed);
  return area;
}

double Surface::velocity_error_bound() const {
  double bound = velocity_error_bound_.load(std::memory_order_relaxed);
  if (bound == not_known) {
    bound = states_ ? riis::velocity_error_bound(*states_, triangles_.grids) : 0;
    velocity_error_bound_.store(bound, std::memory_order_relaxed);
  }
  return bound;
}

void Surface::add_direction(const Direction &direction, int n_threads) {
  const auto n = static_cast<std::size_t>(n_directions_);
  if (rates_.size() == n) rates_.emplace_back();
  make_vertex_rates(*patches(), triangles_.grids, direction, n_threads, rates_[n]);
  ++n_directions_;
}

const Attachment &Surface::attachment() const {
  const std::lock_guard<std::mutex> lock(attachment_mutex_);
  if (!attachment_) attachment_.emplace(attachment_of(triangles_));
  return *attachment_;
}

const std::vector<riis_leaflet> &Surface::leaflets() const {
  const std::lock_guard<std::mutex> lock(leaflets_mutex_);
  if (!leaflets_) leaflets_.emplace(leaflets_of(triangles_));
  return *leaflets_;
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
