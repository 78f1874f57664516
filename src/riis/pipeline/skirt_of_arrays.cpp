// SPDX-License-Identifier: Apache-2.0
#include "pipeline/skirt_of_arrays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "measures/leaflet_boundary.hpp"
#include "measures/leaflet_outline.hpp"
#include "scene/edges.hpp"
#include "scene/pseudonormals.hpp"
#include "valve/skirt.hpp"

namespace riis {
namespace {

// If a second line encloses at least `ambiguous_share` of the largest area, either line may be the attachment.
constexpr double ambiguous_share = 0.99;
constexpr const char *cure = ": name the attached vertices by arrays.attached";

// ---- Attachment ----

// Returns the corner of the edge's triangle that has the same place as `vertex`. The vertex itself may belong to another
// triangle, which may later move away.
std::int64_t corner_at(const TriangleSet &set, std::int64_t triangle, std::int64_t vertex) {
  for (std::int64_t k = 0; k < 3; ++k) {
    const std::int64_t corner = view(set.vertex_id)[3 * triangle + k];
    if (set.vertex(corner) == set.vertex(vertex)) return corner;
  }
  return vertex;
}

AttachedEdge attached_edge(const TriangleSet &set, const OpenEdge &edge) {
  return {corner_at(set, edge.triangle, edge.from), corner_at(set, edge.triangle, edge.to),
          view(set.leaflet_id)[edge.triangle]};
}

// Returns the closed line of open edges that encloses the largest area.
std::vector<OpenEdge> chosen_edges(const TriangleSet &set) {
  LargestBoundary best = largest_boundary(set);
  if (best.edges.empty())
    fail(RIIS_INVALID_SURFACE, "no closed line of open edges encloses an area, so the attachment is not known", cure);
  const double largest = length(best.area);
  const std::optional<SeenOutline> outline = outline_of_leaflets(boundary_of_leaflets(set), std::nullopt);
  const double share = outline ? std::abs(dot(best.area, outline->seen.axis())) / area_of(outline->outline) : 0;
  if (share < least_attached_share)
    fail(RIIS_INVALID_SURFACE, "the largest closed line of open edges encloses ", rounded(share, 2),
         " of the outline of the leaflets, so it is not the attachment of all leaflets", cure);
  if (best.second_area >= ambiguous_share * largest)
    fail(RIIS_INVALID_SURFACE, "two closed lines of open edges enclose the same area, ", rounded(largest, 4),
         ", so the attachment is not known", cure);
  return std::move(best.edges);
}

// Returns the open edges between attached vertices. Refuses an attached vertex without such an edge, because it was probably
// named by mistake.
std::vector<OpenEdge> named_edges(const TriangleSet &set, const UserFaces &faces) {
  std::int64_t n_places = 0;
  const auto place = distinct_positions(set, n_places);
  std::vector<std::uint8_t> is_attached(static_cast<std::size_t>(n_places)),
      has_edge(static_cast<std::size_t>(n_places));
  for (std::int64_t i = 0; i < set.n_vertices(); ++i)
    if (view(faces.skirt.attached)[i] != 0) view(is_attached)[view(place)[i]] = 1;
  const auto at = [&](std::vector<std::uint8_t> &of, std::int64_t vertex) -> std::uint8_t & {
    return view(of)[view(place)[vertex]];
  };
  std::vector<OpenEdge> named;
  for (const OpenEdge &edge : open_edges(set, false)) {
    if (!at(is_attached, edge.from) || !at(is_attached, edge.to)) continue;
    at(has_edge, edge.from) = at(has_edge, edge.to) = 1;
    named.push_back(edge);
  }
  for (std::int64_t i = 0; i < set.n_vertices(); ++i)
    if (view(faces.skirt.attached)[i] != 0 && !at(has_edge, i))
      fail(RIIS_INVALID_SURFACE, "arrays.attached: no open edge leads from vertex ", i + faces.index_base,
           " to another attached vertex, so it is not on the attachment");
  if (named.empty())
    fail(RIIS_INVALID_SURFACE, "arrays.attached is 0 for all ", set.n_vertices(), " vertices: it names no attachment");
  return named;
}

// ---- Direction ----

// A vector with its rate, in mesh units per unit of time.
struct Moving {
  Vec3 now, rate;
};

Moving operator+(const Moving &a, const Moving &b) { return {a.now + b.now, a.rate + b.rate}; }
Moving operator-(const Moving &a, const Moving &b) { return {a.now - b.now, a.rate - b.rate}; }
Moving cross(const Moving &a, const Moving &b) {
  return {riis::cross(a.now, b.now), riis::cross(a.rate, b.now) + riis::cross(a.now, b.rate)};
}

struct MovingNumber {
  double now, rate;
};

MovingNumber dot(const Moving &a, const Moving &b) {
  return {riis::dot(a.now, b.now), riis::dot(a.rate, b.now) + riis::dot(a.now, b.rate)};
}
MovingNumber length_of(const Moving &a) {
  const double size = length(a.now);
  return {size, size > 0 ? riis::dot(a.now, a.rate) / size : 0};
}
Moving operator*(const MovingNumber &s, const Moving &a) { return {s.now * a.now, s.rate * a.now + s.now * a.rate}; }
Moving operator/(const Moving &a, const MovingNumber &s) {
  return {(1 / s.now) * a.now, (1 / s.now) * (a.rate - (s.rate / s.now) * a.now)};
}

// The line from which the skirt leads away, and the mean distance between the attachment and this line.
class SkirtLine {
 public:
  explicit SkirtLine(const TriangleSet &set) : set_(set) {
    // The first vertex is the origin, because this keeps rounding errors small if the surface is far from the origin of
    // coordinates.
    const Moving origin = vertex(set.attached.front().from);
    MovingNumber whole{0, 0};
    Moving moment{}, area{};
    for (const AttachedEdge &edge : set.attached) {
      const Moving a = vertex(edge.from) - origin, b = vertex(edge.to) - origin;
      const MovingNumber size = length_of(b - a);
      whole = {whole.now + size.now, whole.rate + size.rate};
      moment = moment + MovingNumber{0.5 * size.now, 0.5 * size.rate} * (a + b);
    }
    if (!(whole.now > 0)) return;
    const Moving centre = moment / whole;
    centre_ = origin + centre;
    for (const AttachedEdge &edge : set.attached) {
      const Moving a = vertex(edge.from) - centre_, b = vertex(edge.to) - centre_;
      area = area + MovingNumber{0.5, 0} * cross(a, b);
    }
    // The area is compared with the area of a circle whose circumference is the length of the attachment, as for valves from
    // patches.
    const MovingNumber size = length_of(area);
    if (!(size.now > 1e-3 * whole.now * whole.now)) return;
    direction_ = area / size;
    double sum = 0;
    for (const AttachedEdge &edge : set.attached)
      sum += 0.5 * distance(set.vertex(edge.from), set.vertex(edge.to)) *
             (length(from_line(edge.from).now) + length(from_line(edge.to).now));
    radius_ = sum / whole.now;
  }

  bool has_direction() const { return radius_ > 0; }
  double radius() const { return radius_; }
  AxisLine axis() const { return {centre_.now, direction_.now}; }

  Moving vertex(std::int64_t id) const {
    const double *const v = set_.velocity.empty() ? nullptr : set_.velocity.data() + 3 * id;
    return {set_.vertex(id), v ? Vec3{v[0], v[1], v[2]} : Vec3{0, 0, 0}};
  }
  // Returns the direction of the skirt at a vertex.
  Moving outwards(std::int64_t id) const {
    const Moving q = from_line(id);
    const MovingNumber size = length_of(q);
    if (!(size.now > 1e-6 * radius_)) {
      const Vec3 p = set_.vertex(id);
      fail(RIIS_INVALID_SURFACE, "a skirt has no direction at (", p.x, ", ", p.y, ", ", p.z,
           "), where the attachment reaches its axis");
    }
    return q / size;
  }

 private:
  Moving from_line(std::int64_t id) const {
    const Moving from_centre = vertex(id) - centre_;
    return from_centre - dot(from_centre, direction_) * direction_;
  }

  const TriangleSet &set_;
  Moving centre_{}, direction_{};
  double radius_ = 0;
};

// ---- Strip ----

class StripMaker {
 public:
  StripMaker(const UserFaces &faces, double scale, const SkirtLine &line, TriangleSet &set)
      : faces_(faces), scale_(scale), line_(line), set_(set) {
    const double longest = scale * faces.skirt.length, radius = line.radius();
    if (!(longest >= least_skirt * radius && longest <= most_skirt * radius))
      fail(RIIS_INVALID_ARGUMENT, "arrays.skirt_length is ", faces.skirt.length, "; it must be 0, or from ",
           least_skirt, " to ", most_skirt, " times the mean distance of the attachment from its axis, which is ",
           rounded(radius / scale, 4));
    for (const AttachedEdge &edge : faces.skirt.edges)
      for (const std::int64_t id : {edge.from, edge.to}) check_length(id);
  }

  void add(const AttachedEdge &edge, std::int64_t triangle_id, std::int32_t leaflet_id) {
    const std::int64_t a = edge.from, b = edge.to, outer_a = outer(a), outer_b = outer(b);
    const std::int64_t corners[2][3] = {{b, a, outer_a}, {b, outer_a, outer_b}};
    for (const auto &ids : corners) {
      const std::int64_t id = triangle_id++;
      if (has_zero_area(set_.vertex(ids[0]), set_.vertex(ids[1]), set_.vertex(ids[2]))) {
        ++set_.n_zero_area;
        continue;
      }
      set_.vertex_id.insert(set_.vertex_id.end(), {ids[0], ids[1], ids[2]});
      set_.triangle_id.push_back(id);
      set_.leaflet_id.push_back(leaflet_id);
      set_.patch_id.push_back(1);
    }
  }

 private:
  double given_length(std::int64_t id) const {
    return faces_.skirt.lengths.empty() ? faces_.skirt.length : view(faces_.skirt.lengths)[id];
  }

  void check_length(std::int64_t id) const {
    if (!(given_length(id) <= faces_.skirt.length))
      fail(RIIS_INVALID_ARGUMENT, "arrays.skirt_lengths of vertex ", id + faces_.index_base, " is ", given_length(id),
           "; it must be at most arrays.skirt_length, ", faces_.skirt.length);
  }

  // Returns the outer vertex of the skirt that belongs to an attached vertex.
  std::int64_t outer(std::int64_t id) {
    const auto [found, is_new] = outer_of_.try_emplace(id, set_.n_vertices());
    if (!is_new) return found->second;
    const Moving made =
        line_.vertex(id) +
        MovingNumber{std::max(scale_ * given_length(id), least_skirt * line_.radius()), 0} * line_.outwards(id);
    set_.xyz.insert(set_.xyz.end(), {made.now.x, made.now.y, made.now.z});
    if (!set_.velocity.empty()) set_.velocity.insert(set_.velocity.end(), {made.rate.x, made.rate.y, made.rate.z});
    return found->second;
  }

  const UserFaces &faces_;
  double scale_;
  const SkirtLine &line_;
  TriangleSet &set_;
  std::unordered_map<std::int64_t, std::int64_t> outer_of_;
};

}  // namespace

void find_attachment(UserFaces &faces, const riis_surface_arrays &arrays) {
  if (!faces.skirt.has_attachment()) return;
  riis_surface_arrays resting = arrays;
  resting.vx = resting.vy = resting.vz = nullptr;
  const TriangleSet set = triangles_from_arrays(faces, resting, {1, no_rotation, {0, 0, 0}}, true, false);
  faces.skirt.edges.clear();
  for (const OpenEdge &edge : faces.skirt.attached.empty() ? chosen_edges(set) : named_edges(set, faces))
    faces.skirt.edges.push_back(attached_edge(set, edge));
}

void add_skirt_of_arrays(const UserFaces &faces, double scale, bool flip_normals, TriangleSet &set) {
  if (faces.skirt.edges.empty()) return;
  for (AttachedEdge edge : faces.skirt.edges) {
    if (flip_normals) std::swap(edge.from, edge.to);
    set.attached.push_back(edge);
  }
  const SkirtLine line(set);
  set.attached_axis = line.axis();
  if (faces.skirt.length == 0) return;
  if (!line.has_direction())
    fail(RIIS_INVALID_SURFACE, "a skirt has no direction, because the attachment encloses no area");
  const std::int64_t n_faces = view(faces.leaflet_id).size();
  const std::int64_t n_given = n_faces * (faces.corners_per_face - 2), n_edges = view(set.attached).size();
  if (n_given + 2 * n_edges > max_triangles)
    fail(RIIS_LIMIT_EXCEEDED, "arrays.n_faces is ", n_faces, "; with the skirt there are ", n_given + 2 * n_edges,
         " triangles, and at most ", max_triangles, " are possible");
  const std::int32_t largest = *std::max_element(faces.leaflet_id.begin(), faces.leaflet_id.end());
  if (largest == std::numeric_limits<std::int32_t>::max())
    fail(RIIS_LIMIT_EXCEEDED, "arrays.leaflet_id has ", largest, ", so no larger id is left for the skirt");
  set.skirt = std::max<std::int32_t>(RIIS_LEAFLET_SKIRT, largest + 1);
  StripMaker strip(faces, scale, line, set);
  std::int64_t triangle_id = n_given;
  for (const AttachedEdge &edge : set.attached) strip.add(edge, std::exchange(triangle_id, triangle_id + 2), set.skirt);
}

}  // namespace riis
