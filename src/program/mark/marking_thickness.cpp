// SPDX-License-Identifier: Apache-2.0
#include "program/mark/marking_thickness.hpp"

#include <algorithm>
#include <cmath>

#include "common/array_view.hpp"
#include "common/sets.hpp"
#include "program/base/handles.hpp"

namespace riis::program {
namespace {

using Vector = std::array<double, 3>;

Vector between(const double *from, const double *to) { return {to[0] - from[0], to[1] - from[1], to[2] - from[2]}; }
double dot(const Vector &a, const Vector &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector &a) { return std::hypot(a[0], a[1], a[2]); }
Vector cross(const Vector &a, const Vector &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

void add(Vector &sum, double factor, const Vector &a) {
  for (std::size_t c = 0; c < 3; ++c) view(sum)[c] += factor * view(a)[c];
}

}  // namespace

MarkingThickness::MarkingThickness(const riis_surface *surface) : triangles_(triangles_of(surface)) {
  const riis_surface_info info = info_of(surface);
  band_ = {info.half_thickness, info.offset};
  if (!band_.steps_aside()) return;
  place_ = equal_places(triangles_.n_vertices, triangles_.xyz);
  for (std::int64_t i = 0; i < triangles_.n_triangles; ++i) add_normals(i);
}

std::int32_t MarkingThickness::fields() const {
  return band_.steps_aside() ? RIIS_FIELD_POINT | RIIS_FIELD_BARYCENTRIC | RIIS_FIELD_SIDE | RIIS_FIELD_RIM : 0;
}

MarkingThickness::Feature MarkingThickness::feature(std::int64_t a, std::int64_t b) const {
  const std::int64_t p = view(place_)[a], q = view(place_)[b];
  return {std::min(p, q), std::max(p, q)};
}

void MarkingThickness::add_normals(std::int64_t triangle) {
  const std::int64_t *const id = triangles_.vertex_id + 3 * triangle;
  const auto edge = [&](std::int64_t from, std::int64_t to) {
    return between(triangles_.xyz + 3 * id[from % 3], triangles_.xyz + 3 * id[to % 3]);
  };
  const Vector normal = cross(edge(0, 1), edge(0, 2));
  const double size = length(normal);
  for (std::int64_t k = 0; k < 3; ++k) {
    const double angle = std::atan2(size, dot(edge(k, k + 1), edge(k, k + 2)));
    add(normal_[feature(id[k], id[k])], angle / size, normal);
    add(normal_[feature(id[k], id[(k + 1) % 3])], 1 / size, normal);
  }
}

// The weights that are not 0 belong to the corners of the edge or vertex on which the closest point lies.
MarkingThickness::Vector MarkingThickness::normal_at(const riis_mark_list &list, std::int64_t i) const {
  const std::int64_t *const ids = triangles_.triangle_id;
  const std::int64_t triangle = std::lower_bound(ids, ids + triangles_.n_triangles, list.triangle_id[i]) - ids;
  const std::int64_t *const corner = triangles_.vertex_id + 3 * triangle;
  std::int64_t first = -1, last = -1;
  for (std::int64_t k = 0; k < 3; ++k) {
    if (list.barycentric[3 * i + k] == 0) continue;
    if (first < 0) first = corner[k];
    last = corner[k];
  }
  return normal_.at(feature(first, last));
}

double MarkingThickness::of(const riis_mark_list &list, std::int64_t i, const double *node) const {
  const double distance = list.distance[i];
  if (!band_.steps_aside()) return distance;
  if (!list.rim[i]) return band_.marking_thickness(distance, list.side[i] * distance);
  const Vector normal = normal_at(list, i);
  const double height = dot(between(list.point + 3 * i, node), normal) / length(normal);
  return band_.marking_thickness(distance, std::max(-distance, std::min(height, distance)));
}

}  // namespace riis::program
