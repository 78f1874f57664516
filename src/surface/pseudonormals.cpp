// SPDX-License-Identifier: Apache-2.0
#include "surface/pseudonormals.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <tuple>

#include "base/array_view.hpp"
#include "base/constants.hpp"
#include "surface/rims.hpp"

namespace riis {
namespace {

std::uint64_t hash(Vec3 p) {
  std::uint64_t h = 0;
  for (const double coordinate : {p.x, p.y, p.z}) {
    const double positive_zero = coordinate + 0.0;  // -0 and 0 are the same place
    std::uint64_t bits;
    std::memcpy(&bits, &positive_zero, sizeof bits);
    h = (h ^ bits) * 0x9e3779b97f4a7c15;
    h ^= h >> 32;
  }
  return h;
}

// Numbers all vertices; vertices with equal coordinates get the same number.
Vector<std::int64_t> distinct_positions(const TriangleSet &set, std::int64_t &n_positions) {
  // A table of vertices that is at most half full. Each vertex is at the first place from its hash on that was free.
  constexpr std::int32_t none = -1;
  Vector<std::int64_t> position;
  resize(position, set.n_vertices());
  std::size_t size = 16;
  while (size < 2 * position.size()) size *= 2;
  Vector<std::int32_t> table(size, none);
  n_positions = 0;
  for (std::int64_t i = 0; i < set.n_vertices(); ++i) {
    const Vec3 p = set.vertex(i);
    std::size_t at = hash(p) & (size - 1);
    while (table[at] != none && !(set.vertex(table[at]) == p)) at = (at + 1) & (size - 1);
    if (table[at] == none) {
      table[at] = static_cast<std::int32_t>(i);
      view(position)[i] = n_positions++;
    } else {
      view(position)[i] = view(position)[table[at]];
    }
  }
  return position;
}

// The third angle follows from the other two, because an arc tangent is dear.
std::array<double, 3> angles_of(const std::array<Vec3, 3> &corners) {
  const auto &[a, b, c] = corners;
  const double twice_area = length(cross(b - a, c - a)), at_a = std::atan2(twice_area, dot(b - a, c - a)),
               at_b = std::atan2(twice_area, dot(c - b, a - b));
  return {at_a, at_b, std::max(0.0, pi - at_a - at_b)};
}

}  // namespace

Vec3 triangle_normal(const std::array<Vec3, 3> &corners) {
  const auto &[a, b, c] = corners;
  // Edges are scaled first, so that neither small nor large triangles leave the range of doubles.
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const double longest = std::sqrt(std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)}));
  const Vec3 n = cross((1.0 / longest) * (b - a), (1.0 / longest) * (c - a));
  return (1.0 / length(n)) * n;
}

Pseudonormals::Pseudonormals(const TriangleSet &set) {
  const std::int64_t n = set.n_triangles();
  std::int64_t n_positions = 0;
  const Vector<std::int64_t> position_of_vertex = distinct_positions(set, n_positions);
  resize(face_, n);
  resize(edge_, 3 * n);
  resize(corner_, n_positions);
  resize(position_, 3 * n);
  resize(edge_is_rim_, 3 * n);
  resize(corner_is_rim_, n_positions);
  // Edges are listed by their lower end. Each list is short, and equal edges follow each other once it is sorted.
  Vector<std::int64_t> first_edge;
  resize(first_edge, n_positions + 1);
  for (std::int64_t i = 0; i < n; ++i) {
    const std::array<Vec3, 3> corners = set.corners(i);
    const Vec3 normal = view(face_)[i] = triangle_normal(corners);
    const std::array<double, 3> angles = angles_of(corners);
    for (std::int64_t k = 0; k < 3; ++k) {
      const std::int64_t position = view(position_of_vertex)[view(set.vertex_id)[3 * i + k]];
      view(position_)[3 * i + k] = position;
      Vec3 &sum = view(corner_)[position];
      sum = sum + view(angles)[k] * normal;
    }
    for (std::int64_t k = 0; k < 3; ++k) ++view(first_edge)[ends_of(3 * i + k).lower + 1];
  }
  std::partial_sum(first_edge.begin(), first_edge.end(), first_edge.begin());
  struct Edge {
    std::int64_t upper, slot;  // position of its upper end, place in edge_
  };
  Vector<Edge> edges;
  resize(edges, 3 * n);
  Vector<std::int64_t> next(first_edge.begin(), first_edge.end() - 1);
  for (std::int64_t slot = 0; slot < 3 * n; ++slot) {
    const auto [lower, upper] = ends_of(slot);
    view(edges)[view(next)[lower]++] = {upper, slot};
  }
  for (std::int64_t lower = 0; lower < n_positions; ++lower) {
    const auto begin = edges.begin() + view(first_edge)[lower], end = edges.begin() + view(first_edge)[lower + 1];
    // Equal edges are in the order of their slots, so that the sums have the same bits however the ends are numbered.
    std::sort(begin, end,
              [](const Edge &a, const Edge &b) { return std::tie(a.upper, a.slot) < std::tie(b.upper, b.slot); });
    for (auto first = begin; first != end;) {
      Vec3 sum{0, 0, 0};
      auto last = first;
      for (; last != end && last->upper == first->upper; ++last) sum = sum + view(face_)[last->slot / 3];
      const bool is_single = last - first == 1;
      for (; first != last; ++first) {
        const std::int64_t slot = first->slot;
        view(edge_)[slot] = sum;
        if (!(set.rim_sides.empty() ? is_single : is_on_rim_side(set, slot / 3, slot % 3))) continue;
        view(edge_is_rim_)[slot] = 1;
        view(corner_is_rim_)[lower] = view(corner_is_rim_)[first->upper] = 1;
      }
    }
  }
}

Pseudonormals::Ends Pseudonormals::ends_of(std::int64_t slot) const {
  const std::int64_t triangle = slot / 3, k = slot % 3;
  const auto position = view(position_);
  const auto [lower, upper] = std::minmax(position[slot], position[3 * triangle + (k + 1) % 3]);
  return {lower, upper};
}

Pseudonormals::Place Pseudonormals::place_of(Vec3 barycentric) {
  // By the weights that are 0: the first counts 1, the second 2, the third 4.
  static constexpr Place places[8] = {{Kind::face, 0}, {Kind::edge, 1},   {Kind::edge, 2},   {Kind::vertex, 2},
                                      {Kind::edge, 0}, {Kind::vertex, 1}, {Kind::vertex, 0}, {Kind::vertex, 0}};
  return places[(barycentric.x == 0 ? 1 : 0) + (barycentric.y == 0 ? 2 : 0) + (barycentric.z == 0 ? 4 : 0)];
}

Pseudonormals::Feature Pseudonormals::at_border(std::int64_t triangle, Vec3 barycentric) const {
  const auto [kind, corner] = place_of(barycentric);
  if (kind == Kind::face) return {of_face(triangle), false};
  const std::int64_t slot = 3 * triangle + corner, position = view(position_)[slot];
  const bool is_vertex = kind == Kind::vertex;
  const Vec3 normal = is_vertex ? view(corner_)[position] : view(edge_)[slot];
  const bool is_on_rim = (is_vertex ? view(corner_is_rim_)[position] : view(edge_is_rim_)[slot]) != 0;
  // Faces folded onto each other cancel up to rounding; the triangle's own normal then takes their place.
  return {dot(normal, normal) > 1e-18 ? normal : of_face(triangle), is_on_rim};
}

}  // namespace riis
