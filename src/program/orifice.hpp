// SPDX-License-Identifier: Apache-2.0
// The orifice: the area inside an outline that triangles leave uncovered when both are projected along z.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "program/patch_sides.hpp"

namespace riis::program {

using PlanePoint = std::array<double, 2>;
using PlaneTriangle = std::array<PlanePoint, 3>;

// A circle, or closed lines.
struct Outline {
  double radius = 0;  // > 0: the outline is this circle
  PlanePoint centre{};
  // If there is no circle: a point is inside if the number of edges to its left is odd.
  std::vector<std::array<PlanePoint, 2>> edges{};
};

Outline circle(double radius, const PlanePoint &centre);
// Returns the outline of the projected lines, or nothing if they enclose no area or are not closed. Closed lines have an even
// number of ends at each place.
std::optional<Outline> closed_outline(const std::vector<Line> &lines);

std::vector<PlaneTriangle> projected(const riis_triangles &surface);

// The number of lines along x that measure areas. They are evenly spaced over the outline. On each line the uncovered parts
// have their exact length. An edge along x is off by at most half a spacing, 1/4096 of the outline's height.
inline constexpr std::int64_t n_scan_lines = 2048;

double area_of(const Outline &outline, std::int64_t n_lines = n_scan_lines);
double uncovered_area(const Outline &outline, const std::vector<PlaneTriangle> &triangles,
                      std::int64_t n_lines = n_scan_lines);

}  // namespace riis::program
