// SPDX-License-Identifier: Apache-2.0
#include "orifice_shim.h"
#include "calls.h"

#include "program/orifice.hpp"

using namespace riis::program;

namespace {

std::vector<PlaneTriangle> triangles_of(int64_t n, const double *corners) {
  std::vector<PlaneTriangle> triangles;
  for (const double *c = corners; n > 0; --n, c += 6)
    triangles.push_back({PlanePoint{c[0], c[1]}, PlanePoint{c[2], c[3]}, PlanePoint{c[4], c[5]}});
  return triangles;
}

}  // namespace

double shim_circle_area(double radius, const double centre[2], int64_t n_lines) {
  return area_of(circle(radius, {centre[0], centre[1]}), n_lines);
}

double shim_uncovered_circle(double radius, const double centre[2], int64_t n_triangles, const double *corners,
                             int64_t n_lines) {
  return uncovered_area(circle(radius, {centre[0], centre[1]}), triangles_of(n_triangles, corners), n_lines);
}

double shim_uncovered_inside(int64_t n_segments, const double *points, int64_t n_triangles, const double *corners,
                             int64_t n_lines) {
  std::vector<Line> lines;
  for (const double *p = points; n_segments > 0; --n_segments, p += 6)
    lines.push_back({Point{p[0], p[1], p[2]}, Point{p[3], p[4], p[5]}});
  const auto outline = closed_outline(lines);
  return outline ? uncovered_area(*outline, triangles_of(n_triangles, corners), n_lines) : -1;
}
