// SPDX-License-Identifier: Apache-2.0
// The part of an outline in the plane that triangles leave uncovered: its area, and the length of its edge.
// In: an outline, triangles in the plane. Out: areas and lengths, also of the part that is left if the triangles grow.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace riis {

using PlanePoint = std::array<double, 2>;
using PlaneTriangle = std::array<PlanePoint, 3>;
using PlaneSegment = std::array<PlanePoint, 2>;

// A circle, or closed lines.
struct Outline {
  double radius = 0;  // > 0: the outline is this circle
  PlanePoint centre{};
  // If there is no circle: a point is inside if the number of edges to its left is odd.
  std::vector<PlaneSegment> edges{};
};

Outline circle(double radius, const PlanePoint &centre);
// Returns the outline of these lines, or nothing if they enclose no area or are not closed. Closed lines have an even number of
// ends at each place. Coordinates may be off by `rounding`, which encloses an area, too.
std::optional<Outline> closed_outline(const std::vector<std::vector<PlanePoint>> &lines, double rounding = 0);

// Triangles, and the edges that may bound what they cover: all but edges between two triangles on opposite sides.
struct Cover {
  std::vector<PlaneTriangle> triangles;
  std::vector<PlaneSegment> rim;
};

// Makes the cover of triangles that are given by their vertices.
Cover cover_of(const std::vector<PlanePoint> &vertices, const std::vector<std::int64_t> &vertex_id);

// The number of lines along x that measure areas. They are evenly spaced over the outline. On each line the uncovered parts
// have their exact length. An edge along x is off by at most half a spacing, 1/4096 of the outline's height.
inline constexpr std::int64_t n_scan_lines = 2048;

// The lines that measure lengths of edges, in either direction.
inline constexpr std::int64_t n_edge_lines = 512;

double area_of(const Outline &outline, std::int64_t n_lines = n_scan_lines);

// Returns the area of the points inside the outline that are farther than `reach` from all triangles.
double uncovered_area(const Outline &outline, const Cover &cover, double reach, std::int64_t n_lines = n_scan_lines);

// Returns the length of that part's edge, without the outline. Lines along x count the edges that are steep to them, lines along
// y the others. An edge ends up to a spacing early or late.
double uncovered_edge(const Outline &outline, const Cover &cover, double reach, std::int64_t n_lines = n_edge_lines);

}  // namespace riis
