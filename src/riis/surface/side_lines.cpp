// SPDX-License-Identifier: Apache-2.0
#include "surface/side_lines.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "common/array_view.hpp"
#include "surface/rims.hpp"

namespace riis {
namespace {

constexpr std::int64_t nowhere = -1;

bool is_corner(const TriangleSet &set, std::int64_t id) {
  return view(set.uv)[2 * id] == 0 && view(set.uv)[2 * id + 1] == 0;
}

// A patch's vertices are consecutive and begin at u = v = 0. A vertex that is in no triangle belongs to the patch that begins
// before it. Such vertices come from triangles without area.
std::vector<std::int64_t> triangles_of_vertices(const TriangleSet &set) {
  std::vector<std::int64_t> triangle(static_cast<std::size_t>(set.n_vertices()), nowhere);
  for (std::int64_t i = 0; i < 3 * set.n_triangles(); ++i) view(triangle)[view(set.vertex_id)[i]] = i / 3;
  const auto patch_of = [&](std::int64_t id) { return view(set.patch_id)[view(triangle)[id]]; };
  std::int64_t last = nowhere;  // the last vertex in a triangle
  for (std::int64_t id = 0; id < set.n_vertices(); ++id) {
    if (view(triangle)[id] == nowhere) continue;
    const bool is_next_patch = last == nowhere || patch_of(last) != patch_of(id);
    std::int64_t begin = last + 1;
    while (is_next_patch && begin < id && !is_corner(set, begin)) ++begin;
    for (std::int64_t gap = last + 1; gap < id; ++gap)
      view(triangle)[gap] = gap < begin && last != nowhere ? view(triangle)[last] : view(triangle)[id];
    last = id;
  }
  for (std::int64_t gap = last + 1; gap < set.n_vertices(); ++gap) view(triangle)[gap] = view(triangle)[last];
  return triangle;
}

struct PointAlong {
  double u;
  Vec3 point;
};

Line line_of(std::vector<PointAlong> points) {
  std::sort(points.begin(), points.end(), [](const PointAlong &a, const PointAlong &b) { return a.u < b.u; });
  Line line;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i == 0 || points[i].u != points[i - 1].u) line.push_back(points[i].point);
  return line;
}

// Returns the lines v = 0 or v = 1 of the patches that have the bit.
std::vector<SideLine> lines_with(const TriangleSet &set, std::uint8_t bit, double v) {
  struct Found {
    std::int32_t leaflet_id;
    std::vector<PointAlong> points;
  };
  std::map<std::int32_t, Found> found;
  if (set.rim_sides.empty() || set.n_triangles() == 0) return {};
  const std::vector<std::int64_t> triangle = triangles_of_vertices(set);
  for (std::int64_t id = 0; id < set.n_vertices(); ++id) {
    const std::int32_t patch_id = view(set.patch_id)[view(triangle)[id]];
    if ((view(set.rim_sides)[patch_id] & bit) == 0 || view(set.uv)[2 * id + 1] != v) continue;
    Found &of_patch = found[patch_id];
    of_patch.leaflet_id = view(set.leaflet_id)[view(triangle)[id]];
    of_patch.points.push_back({view(set.uv)[2 * id], set.vertex(id)});
  }
  std::vector<SideLine> lines;
  for (auto &[patch_id, of_patch] : found) {
    Line line = line_of(std::move(of_patch.points));
    if (line_length(line) > 0) lines.push_back({of_patch.leaflet_id, std::move(line)});
  }
  return lines;
}

}  // namespace

std::vector<SideLine> free_edges(const TriangleSet &set) { return lines_with(set, free_v1, 1); }

std::vector<SideLine> attachment(const TriangleSet &set) { return lines_with(set, rim_v0, 0); }

}  // namespace riis
