// SPDX-License-Identifier: Apache-2.0
// Measures the part of an outline in the plane that triangles leave uncovered: its area, and the length of its edge. Before the
// measurement, the triangles may grow by a given distance.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace riis {

using PlanePoint = std::array<double, 2>;
using PlaneTriangle = std::array<PlanePoint, 3>;
using PlaneSegment = std::array<PlanePoint, 2>;

// An outline is a circle or a set of closed lines.
struct Outline {
  double radius = 0;  // > 0: the outline is this circle
  PlanePoint centre{};
  // These edges are used if radius is 0. A point is inside if the number of edges to its left is odd.
  std::vector<PlaneSegment> edges{};
};

Outline circle(double radius, const PlanePoint &centre);
// Returns the outline that these lines form. Returns nothing if the lines are not closed or enclose no area. Lines are closed if
// an even number of ends meets at each place. Coordinates may have errors up to `rounding`, so an area that could come from such
// errors counts as none.
std::optional<Outline> closed_outline(const std::vector<std::vector<PlanePoint>> &lines, double rounding = 0);

// The triangles, and the rim: the edges that may bound the covered part. An edge is no part of the rim if two triangles share it
// and lie on opposite sides of it.
struct Cover {
  std::vector<PlaneTriangle> triangles;
  std::vector<PlaneSegment> rim;
};

// Makes the cover. `vertices` has the positions of all vertices, and `vertex_id` has three vertices for each triangle.
Cover cover_of(const std::vector<PlanePoint> &vertices, const std::vector<std::int64_t> &vertex_id);

// The number of lines along x that measure areas. The lines are evenly spaced over the outline. The uncovered length of each line
// is exact. The error of an edge's position is at most half the spacing, which is 1/4096 of the outline's height.
inline constexpr std::int64_t n_scan_lines = 2048;

// The number of lines along x, and also along y, that measure the lengths of edges.
inline constexpr std::int64_t n_edge_lines = 512;

double area_of(const Outline &outline, std::int64_t n_lines = n_scan_lines);

// Areas inside the outline.
struct UncoveredAreas {
  double outside = 0;       // outside all triangles
  double beyond_reach = 0;  // farther than a reach from all triangles
};
UncoveredAreas uncovered_areas(const Outline &outline, const Cover &cover, double reach,
                               std::int64_t n_lines = n_scan_lines);

// Returns the length of the edge of the area beyond the reach. The outline itself does not count. Lines along x measure the steep
// edges, and lines along y measure the flat edges. The error at each end of an edge is at most one spacing of the lines.
double uncovered_edge(const Outline &outline, const Cover &cover, double reach, std::int64_t n_lines = n_edge_lines);

}  // namespace riis
