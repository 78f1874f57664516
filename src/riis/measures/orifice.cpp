// SPDX-License-Identifier: Apache-2.0
#include "measures/measures.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "common/array_view.hpp"
#include "measures/plane_cover.hpp"
#include "scene/edges.hpp"

namespace riis {
namespace {

// Projects points along an axis.
class AlongAxis {
 public:
  // The axis of a placed valve. The projection undoes the rotation and the translation, keeps the scale, and drops z. A warped
  // valve is seen along its warped axis.
  explicit AlongAxis(const SourceValve &source)
      : x_axis_(source.placement.rotation * Vec3{1, 0, 0}),
        y_axis_(source.placement.rotation * Vec3{0, 1, 0}),
        axis_(source.axis()),
        origin_(source.placement.translation) {
    if (!source.is_warped) return;
    // Of the x and y axes, takes the one that is nearer to a right angle with the axis of view. It gives the better direction
    // across.
    const Vec3 across = cross(axis_, std::abs(dot(x_axis_, axis_)) < std::abs(dot(y_axis_, axis_)) ? x_axis_ : y_axis_);
    y_axis_ = (1 / length(across)) * across;
    x_axis_ = cross(y_axis_, axis_);
  }

  // An axis of length 1 through a point.
  AlongAxis(Vec3 axis, Vec3 origin) : axis_(axis), origin_(origin) {
    // The coordinate axis that is nearest to a right angle with `axis` gives the second direction.
    const double x = std::abs(axis.x), y = std::abs(axis.y), z = std::abs(axis.z);
    const Vec3 across = cross(axis, x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
    x_axis_ = (1 / length(across)) * across;
    y_axis_ = cross(axis, x_axis_);
  }

  Vec3 axis() const { return axis_; }
  // The rounding grows with the distance of the axis from the origin of coordinates.
  double rounding() const { return 0x1p-48 * length(origin_); }

  PlanePoint operator()(Vec3 p) const {
    const Vec3 from_origin = p - origin_;
    return {dot(x_axis_, from_origin), dot(y_axis_, from_origin)};
  }

 private:
  Vec3 x_axis_{}, y_axis_{}, axis_, origin_;
};

// An outline with the axis along which it is seen.
struct SeenOutline {
  AlongAxis seen;
  std::optional<Outline> outline;
};

SeenOutline outline_of(const TriangleSet &set, const SourceValve &source) {
  const AlongAxis seen(source);
  const Valve::Disc &disc = source.disc;
  const double scale = source.placement.scale;
  std::vector<std::vector<PlanePoint>> lines;
  if (!disc.rim.empty()) {
    lines.emplace_back();
    for (const Vec3 &p : disc.rim) lines.back().push_back(seen(place(source.placement, p)));
    lines.back().push_back(lines.back().front());
    return {seen, closed_outline(lines, seen.rounding())};
  }
  if (disc.radius > 0) return {seen, circle(scale * disc.radius, {scale * disc.x, scale * disc.y})};
  for (const SideLine &side : attached_sides(set)) {
    lines.emplace_back();
    for (const std::int64_t id : side.vertex_id) lines.back().push_back(seen(set.vertex(id)));
  }
  return {seen, closed_outline(lines, seen.rounding())};
}

// Returns the outline that the longest boundary makes, seen along its vector area. Edges run as in their triangles, so the vector
// area points to the side to which the normals point. Without an outline the axis is 0.
SeenOutline outline_of_boundary(const TriangleSet &set) {
  const std::vector<OpenEdge> boundary = longest_boundary(set);
  double whole = 0;
  Vec3 centre{0, 0, 0}, area{0, 0, 0};
  for (const OpenEdge &edge : boundary) {
    const Vec3 a = set.vertex(edge.from), b = set.vertex(edge.to);
    const double size = distance(a, b);
    whole += size, centre = centre + 0.5 * size * (a + b);
  }
  if (!(whole > 0)) return {{Vec3{0, 0, 0}, {0, 0, 0}}, std::nullopt};
  centre = (1 / whole) * centre;
  for (const OpenEdge &edge : boundary)
    area = area + 0.5 * cross(set.vertex(edge.from) - centre, set.vertex(edge.to) - centre);
  const double size = length(area);
  // A circle with the perimeter `whole` encloses the area whole^2 / (4 pi). A line that encloses far less is no outline.
  if (!(size > 1e-3 * whole * whole)) return {{Vec3{0, 0, 0}, {0, 0, 0}}, std::nullopt};
  const AlongAxis seen((1 / size) * area, centre);
  std::vector<PlanePoint> line;
  for (const OpenEdge &edge : boundary) line.push_back(seen(set.vertex(edge.from)));
  line.push_back(line.front());
  return {seen, closed_outline({line}, seen.rounding())};
}

// Returns the vertices of all triangles outside one leaflet.
std::vector<std::int64_t> without_leaflet(const TriangleSet &set, std::int32_t leaflet_id) {
  std::vector<std::int64_t> kept;
  kept.reserve(set.vertex_id.size());
  for (std::int64_t i = 0; i < set.n_triangles(); ++i)
    if (view(set.leaflet_id)[i] != leaflet_id)
      kept.insert(kept.end(), set.vertex_id.begin() + 3 * i, set.vertex_id.begin() + 3 * i + 3);
  return kept;
}

Orifice measured(const TriangleSet &set, const SeenOutline &from, std::int32_t kind, std::int32_t skirt,
                 const OrificeLimits &limits) {
  if (!from.outline) return {0, 0, 0, 0, from.seen.axis(), RIIS_OUTLINE_NONE};
  std::vector<PlanePoint> vertices;
  vertices.reserve(set.xyz.size() / 3);
  for (std::int64_t i = 0; i < set.n_vertices(); ++i) vertices.push_back(from.seen(set.vertex(i)));
  const Cover cover = cover_of(vertices, skirt < 0 ? set.vertex_id : without_leaflet(set, skirt));
  const Outline &outline = *from.outline;
  return {uncovered_area(outline, cover, 0),
          area_of(outline),
          uncovered_edge(outline, cover, limits.slit),
          uncovered_area(outline, cover, limits.reach),
          from.seen.axis(),
          kind};
}

}  // namespace

Orifice measure_orifice(const TriangleSet &set, const SourceValve *source, const OrificeLimits &limits) {
  if (!source) return measured(set, outline_of_boundary(set), RIIS_OUTLINE_BOUNDARY, -1, limits);
  const std::int32_t kind = source->disc.radius > 0 ? RIIS_OUTLINE_DISC : RIIS_OUTLINE_ATTACHMENT;
  return measured(set, outline_of(set, *source), kind, source->skirt, limits);
}

}  // namespace riis
