// SPDX-License-Identifier: Apache-2.0
#include "surface/pseudonormals.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "surface/rims.hpp"

namespace riis {
namespace {

// Numbers all vertices; vertices with equal coordinates get the same number.
std::vector<std::size_t> distinct_positions(const TriangleSet &set, std::size_t &n_positions) {
  const auto key = [&](std::size_t vertex) {
    const Vec3 p = set.vertex(static_cast<std::int64_t>(vertex));
    return std::make_tuple(p.x, p.y, p.z);
  };
  std::vector<std::size_t> order(set.n_vertices()), position(set.n_vertices());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  n_positions = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || key(order[i - 1]) != key(order[i])) ++n_positions;
    position[order[i]] = n_positions - 1;
  }
  return position;
}

double angle_between(Vec3 a, Vec3 b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

}  // namespace

Vec3 triangle_normal(const std::array<Vec3, 3> &corners) {
  const auto &[a, b, c] = corners;
  // Edges are scaled first, so that neither small nor large triangles leave the range of doubles.
  const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
  const Vec3 n = cross((1.0 / longest) * (b - a), (1.0 / longest) * (c - a));
  return (1.0 / length(n)) * n;
}

Pseudonormals::Pseudonormals(const TriangleSet &set) {
  const std::size_t n = set.n_triangles();
  std::size_t n_positions = 0;
  const std::vector<std::size_t> position_of_vertex = distinct_positions(set, n_positions);
  face_.resize(n);
  edge_.resize(3 * n);
  corner_.assign(n_positions, Vec3{0, 0, 0});
  position_.resize(3 * n);
  edge_is_rim_.resize(3 * n);
  corner_is_rim_.resize(n_positions);
  struct Edge {
    std::size_t lower, upper, slot;  // positions of its ends, place in edge_
  };
  std::vector<Edge> edges(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::array<Vec3, 3> corners = set.corners(i);
    face_[i] = triangle_normal(corners);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 here = corners[k], next = corners[(k + 1) % 3], previous = corners[(k + 2) % 3];
      position_[3 * i + k] = position_of_vertex[static_cast<std::size_t>(set.vertex_id[3 * i + k])];
      Vec3 &sum = corner_[position_[3 * i + k]];
      sum = sum + angle_between(next - here, previous - here) * face_[i];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [lower, upper] = std::minmax(position_[3 * i + k], position_[3 * i + (k + 1) % 3]);
      edges[3 * i + k] = {lower, upper, 3 * i + k};
    }
  }
  const auto ends = [](const Edge &edge) { return std::tie(edge.lower, edge.upper); };
  std::sort(edges.begin(), edges.end(), [&](const Edge &a, const Edge &b) {
    return std::tie(a.lower, a.upper, a.slot) < std::tie(b.lower, b.upper, b.slot);
  });
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first;
    Vec3 sum{0, 0, 0};
    for (; last < edges.size() && ends(edges[last]) == ends(edges[first]); ++last)
      sum = sum + face_[edges[last].slot / 3];
    const bool is_single = last - first == 1;
    for (; first < last; ++first) {
      const auto [lower, upper, slot] = edges[first];
      edge_[slot] = sum;
      if (!(set.rim_sides.empty() ? is_single : is_on_rim_side(set, slot / 3, slot % 3))) continue;
      edge_is_rim_[slot] = 1;
      corner_is_rim_[lower] = corner_is_rim_[upper] = 1;
    }
  }
}

Pseudonormals::Place Pseudonormals::place_of(const std::array<double, 3> &barycentric) {
  const auto is_zero = [&](std::size_t k) { return barycentric[k] == 0.0; };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3, previous = (k + 2) % 3;
    if (is_zero(next) && is_zero(previous)) return {Feature::vertex, k};
    if (is_zero(previous) && !is_zero(k) && !is_zero(next)) return {Feature::edge, k};
  }
  return {Feature::face, 0};
}

Vec3 Pseudonormals::at(std::size_t triangle, const std::array<double, 3> &barycentric) const {
  const auto [feature, corner] = place_of(barycentric);
  if (feature == Feature::face) return face_[triangle];
  const std::size_t slot = 3 * triangle + corner;
  const Vec3 normal = feature == Feature::vertex ? corner_[position_[slot]] : edge_[slot];
  // Faces folded onto each other cancel up to rounding; the triangle's own normal then takes their place.
  return length(normal) > 1e-9 ? normal : face_[triangle];
}

bool Pseudonormals::is_on_rim(std::size_t triangle, const std::array<double, 3> &barycentric) const {
  const auto [feature, corner] = place_of(barycentric);
  const std::size_t slot = 3 * triangle + corner;
  return feature == Feature::vertex ? corner_is_rim_[position_[slot]] != 0
                                    : feature == Feature::edge && edge_is_rim_[slot] != 0;
}

}  // namespace riis
