// SPDX-License-Identifier: Apache-2.0
#include "surface/orifice.hpp"

#include <cmath>
#include <map>
#include <optional>

#include "common/array_view.hpp"
#include "geometry/plane_cover.hpp"
#include "surface/side_lines.hpp"

namespace riis {
namespace {

// Projects points along the valve's axis. The projection undoes the rotation and the translation, keeps the scale, and drops z.
class AlongAxis {
 public:
  explicit AlongAxis(const ValveFrame &frame)
      : x_axis_(frame.placement.rotation * Vec3{1, 0, 0}),
        y_axis_(frame.placement.rotation * Vec3{0, 1, 0}),
        translation_(frame.placement.translation) {
    if (frame.disc.rim.empty()) return;
    const Vec3 axis = frame.axis();
    // The smaller of both has the better direction across the axis.
    Vec3 across = cross(axis, std::abs(dot(x_axis_, axis)) < std::abs(dot(y_axis_, axis)) ? x_axis_ : y_axis_);
    y_axis_ = (1 / length(across)) * across;
    x_axis_ = cross(y_axis_, axis);
  }

  // Points far from the origin are rounded more.
  double rounding() const { return 0x1p-48 * length(translation_); }

  PlanePoint operator()(Vec3 p) const {
    const Vec3 from_origin = p - translation_;
    return {dot(x_axis_, from_origin), dot(y_axis_, from_origin)};
  }

 private:
  Vec3 x_axis_, y_axis_, translation_;
};

std::optional<Outline> outline_of(const TriangleSet &set, const ValveFrame &frame, const AlongAxis &seen) {
  const Valve::Disc &disc = frame.disc;
  const double scale = frame.placement.scale;
  std::vector<std::vector<PlanePoint>> lines;
  if (!disc.rim.empty()) {
    lines.emplace_back();
    for (const Vec3 &p : disc.rim) lines.back().push_back(seen(place(frame.placement, p)));
    lines.back().push_back(lines.back().front());
    return closed_outline(lines, seen.rounding());
  }
  if (disc.radius > 0) return circle(scale * disc.radius, {scale * disc.x, scale * disc.y});
  for (const SideLine &side : attached_sides(set)) {
    lines.emplace_back();
    for (const std::int64_t id : side.vertex_id) lines.back().push_back(seen(set.vertex(id)));
  }
  return closed_outline(lines, seen.rounding());
}

double area_of_triangle(const TriangleSet &set, std::int64_t i) {
  const auto [a, b, c] = set.corners(i);
  return 0.5 * length(cross(b - a, c - a));
}

}  // namespace

Vec3 ValveFrame::axis() const {
  if (disc.rim.empty()) return placement.rotation * Vec3{0, 0, 1};
  Vec3 area{0, 0, 0};
  for (std::size_t i = 0; i < disc.rim.size(); ++i)
    area = area + cross(disc.rim[i] - disc.rim[0], disc.rim[(i + 1) % disc.rim.size()] - disc.rim[0]);
  return placement.rotation * ((1 / length(area)) * area);
}

Orifice measure_orifice(const TriangleSet &set, const ValveFrame &frame, const OrificeLimits &limits) {
  const AlongAxis seen(frame);
  const std::optional<Outline> outline = outline_of(set, frame, seen);
  if (!outline) return {0, 0, 0, 0, RIIS_OUTLINE_NONE};
  std::vector<PlanePoint> vertices;
  vertices.reserve(set.xyz.size() / 3);
  for (std::int64_t i = 0; i < set.n_vertices(); ++i) vertices.push_back(seen(set.vertex(i)));
  const Cover cover = cover_of(vertices, set.vertex_id);
  return {uncovered_area(*outline, cover, 0), area_of(*outline), uncovered_edge(*outline, cover, limits.slit),
          uncovered_area(*outline, cover, limits.reach),
          frame.disc.radius > 0 ? RIIS_OUTLINE_DISC : RIIS_OUTLINE_ATTACHMENT};
}

std::vector<riis_leaflet> leaflets_of(const TriangleSet &set) {
  std::map<std::int32_t, riis_leaflet> found;
  for (std::int64_t i = 0; i < set.n_triangles(); ++i) {
    const std::int32_t id = view(set.leaflet_id)[i];
    riis_leaflet &leaflet = found.try_emplace(id, riis_leaflet{0, 0, 0, id, 0}).first->second;
    ++leaflet.n_triangles;
    leaflet.area += area_of_triangle(set, i);
  }
  for (const SideLine &edge : free_edges(set)) found.at(edge.leaflet_id).free_edge += length_of(set, edge);
  std::vector<riis_leaflet> leaflets;
  for (const auto &[id, leaflet] : found) leaflets.push_back(leaflet);
  return leaflets;
}

double area_without(const TriangleSet &set, std::int32_t leaflet_id) {
  double area = 0;
  for (const riis_leaflet &leaflet : leaflets_of(set))
    if (leaflet.leaflet_id != leaflet_id) area += leaflet.area;
  return area;
}

}  // namespace riis
