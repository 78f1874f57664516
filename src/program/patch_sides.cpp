// SPDX-License-Identifier: Apache-2.0
#include "program/patch_sides.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "common/array_view.hpp"
#include "program/refusal.hpp"

namespace riis::program {
namespace {

constexpr std::int64_t nowhere = -1;

Point minus(const Point &a, const Point &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point &a, const Point &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double distance(const Point &a, const Point &b) { return std::sqrt(dot(minus(a, b), minus(a, b))); }
Point middle_of(const Point &a, const Point &b) {
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
}

double distance_to_segment(const Point &p, const Point &a, const Point &b) {
  const Point along = minus(b, a);
  const double size = dot(along, along);
  const double t = size > 0 ? std::clamp(dot(minus(p, a), along) / size, 0.0, 1.0) : 0;
  return distance(p, {a[0] + t * along[0], a[1] + t * along[1], a[2] + t * along[2]});
}

double distance_to_line(const Point &p, const Line &line) {
  double nearest = distance(p, line.front());
  for (std::size_t i = 1; i < line.size(); ++i)
    nearest = std::min(nearest, distance_to_segment(p, line[i - 1], line[i]));
  return nearest;
}

// Tells whether both lines go through the same points. One line may have additional vertices on its edges.
bool coincide(const Line &a, const Line &b) {
  const double tolerance = 1e-9 * line_length(a);
  for (std::size_t i = 1; i < a.size(); ++i)
    if (distance_to_line(middle_of(a[i - 1], a[i]), b) > tolerance) return false;
  return true;
}

bool is_corner(const riis_triangles &surface, std::int64_t id) {
  return surface.uv[2 * id] == 0 && surface.uv[2 * id + 1] == 0;
}

// A patch's vertices are consecutive and begin at u = v = 0. A vertex that is in no triangle belongs to the patch that begins
// before it. Such vertices come from triangles without area.
std::vector<std::int64_t> triangles_of_vertices(const riis_triangles &surface) {
  std::vector<std::int64_t> triangle(static_cast<std::size_t>(surface.n_vertices), nowhere);
  for (std::int64_t i = 0; i < 3 * surface.n_triangles; ++i) view(triangle)[surface.vertex_id[i]] = i / 3;
  const auto patch_of = [&](std::int64_t id) { return surface.patch_id[view(triangle)[id]]; };
  std::int64_t last = nowhere;  // the last vertex in a triangle
  for (std::int64_t id = 0; id < surface.n_vertices; ++id) {
    if (view(triangle)[id] == nowhere) continue;
    const bool is_next_patch = last == nowhere || patch_of(last) != patch_of(id);
    std::int64_t begin = last + 1;
    while (is_next_patch && begin < id && !is_corner(surface, begin)) ++begin;
    for (std::int64_t gap = last + 1; gap < id; ++gap)
      view(triangle)[gap] = gap < begin && last != nowhere ? view(triangle)[last] : view(triangle)[id];
    last = id;
  }
  for (std::int64_t gap = last + 1; gap < surface.n_vertices; ++gap) view(triangle)[gap] = view(triangle)[last];
  return triangle;
}

struct PointAlong {
  double along;
  Point point;
};

Line line_of(std::vector<PointAlong> points) {
  std::sort(points.begin(), points.end(), [](const PointAlong &a, const PointAlong &b) { return a.along < b.along; });
  Line line;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i == 0 || points[i].along != points[i - 1].along) line.push_back(points[i].point);
  return line;
}

struct SideId {
  std::size_t patch;
  PatchSide side;
};

using LineEnds = std::pair<Point, Point>;

LineEnds ends_of(const Line &line) { return std::minmax(line.front(), line.back()); }

// Finds sides by their ends. Sides on the same curve have the same ends.
class SidesByEnds {
 public:
  explicit SidesByEnds(const std::vector<PatchSides> &patches) : patches_(patches) {
    for (std::size_t patch = 0; patch < patches.size(); ++patch)
      for (const PatchSide side : {side_v0, side_v1, side_u0, side_u1}) {
        const Line &line = patches[patch].lines[side];
        if (line_length(line) > 0) sides_[ends_of(line)].push_back({patch, side});
      }
  }

  // Returns whether another side has the same place. Sides of other leaflets count only if any_leaflet.
  bool is_shared(const SideId &id, bool any_leaflet) const {
    const PatchSides &own = patches_[id.patch];
    const Line &line = own.lines[id.side];
    const auto &others = sides_.at(ends_of(line));
    return std::any_of(others.begin(), others.end(), [&](const SideId &other) {
      if (other.patch == id.patch && other.side == id.side) return false;
      const PatchSides &patch = patches_[other.patch];
      return (any_leaflet || patch.leaflet_id == own.leaflet_id) && coincide(line, patch.lines[other.side]);
    });
  }

 private:
  const std::vector<PatchSides> &patches_;
  std::map<LineEnds, std::vector<SideId>> sides_;
};

}  // namespace

std::vector<PatchSides> sides_of_patches(const riis_triangles &surface) {
  struct Found {
    std::int32_t leaflet_id;
    std::array<std::vector<PointAlong>, n_sides> points;
  };
  std::map<std::int32_t, Found> found;
  const std::vector<std::int64_t> triangle = triangles_of_vertices(surface);
  for (std::int64_t id = 0; id < surface.n_vertices; ++id) {
    const double u = surface.uv[2 * id], v = surface.uv[2 * id + 1];
    Found &patch = found[surface.patch_id[view(triangle)[id]]];
    patch.leaflet_id = surface.leaflet_id[view(triangle)[id]];
    if (v == 0) patch.points[side_v0].push_back({u, vertex_of(surface, id)});
    if (v == 1) patch.points[side_v1].push_back({u, vertex_of(surface, id)});
    if (u == 0) patch.points[side_u0].push_back({v, vertex_of(surface, id)});
    if (u == 1) patch.points[side_u1].push_back({v, vertex_of(surface, id)});
  }
  std::vector<PatchSides> patches;
  for (auto &[patch_id, patch] : found) {
    patches.push_back({patch_id, patch.leaflet_id, {}});
    for (const PatchSide side : {side_v0, side_v1, side_u0, side_u1})
      patches.back().lines[side] = line_of(std::move(patch.points[side]));
  }
  return patches;
}

double line_length(const Line &line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += distance(line[i - 1], line[i]);
  return length;
}

std::map<std::int32_t, double> areas_of_leaflets(const riis_triangles &surface) {
  std::map<std::int32_t, double> areas;
  for (std::int64_t i = 0; i < surface.n_triangles; ++i) {
    const std::int64_t *id = surface.vertex_id + 3 * i;
    const Point a = vertex_of(surface, id[0]), ab = minus(vertex_of(surface, id[1]), a),
                ac = minus(vertex_of(surface, id[2]), a);
    const Point twice{ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0]};
    areas[surface.leaflet_id[i]] += 0.5 * std::sqrt(dot(twice, twice));
  }
  return areas;
}

std::set<std::int32_t> free_edges(const std::vector<PatchSides> &patches) {
  const SidesByEnds sides(patches);
  std::set<std::int32_t> free;
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (line_length(patches[i].lines[side_v1]) > 0 && !sides.is_shared({i, side_v1}, false))
      free.insert(patches[i].patch_id);
  return free;
}

std::vector<Line> attachment(const std::vector<PatchSides> &patches) {
  const SidesByEnds sides(patches);
  std::vector<Line> lines;
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (line_length(patches[i].lines[side_v0]) > 0 && !sides.is_shared({i, side_v0}, true))
      lines.push_back(patches[i].lines[side_v0]);
  return lines;
}

}  // namespace riis::program
