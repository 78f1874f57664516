// SPDX-License-Identifier: Apache-2.0
#include "plane_cover_shim.h"

#include "measures/plane_cover.hpp"

using namespace riis;

namespace {

Cover triangles_of(int64_t n, const double *corners) {
  Cover cover;
  for (const double *c = corners; n > 0; --n, c += 6)
    cover.triangles.push_back({PlanePoint{c[0], c[1]}, PlanePoint{c[2], c[3]}, PlanePoint{c[4], c[5]}});
  return cover;
}

Cover cover_of_arrays(int64_t n_vertices, const double *xy, int64_t n_triangles, const int64_t *vertex_id) {
  std::vector<PlanePoint> vertices;
  for (int64_t i = 0; i < n_vertices; ++i) vertices.push_back({xy[2 * i], xy[2 * i + 1]});
  return cover_of(vertices, {vertex_id, vertex_id + 3 * n_triangles});
}

}  // namespace

double shim_circle_area(double radius, const double centre[2], int64_t n_lines) {
  return area_of(circle(radius, {centre[0], centre[1]}), n_lines);
}

double shim_uncovered_circle(double radius, const double centre[2], int64_t n_triangles, const double *corners,
                             int64_t n_lines) {
  return uncovered_areas(circle(radius, {centre[0], centre[1]}), triangles_of(n_triangles, corners), 0, n_lines)
      .outside;
}

double shim_uncovered_inside(int64_t n_segments, const double *points, int64_t n_triangles, const double *corners,
                             int64_t n_lines) {
  std::vector<std::vector<PlanePoint>> lines;
  for (const double *p = points; n_segments > 0; --n_segments, p += 6)
    lines.push_back({PlanePoint{p[0], p[1]}, PlanePoint{p[3], p[4]}});
  const auto outline = closed_outline(lines);
  return outline ? uncovered_areas(*outline, triangles_of(n_triangles, corners), 0, n_lines).outside : -1;
}

double shim_area_beyond(double radius, const double centre[2], int64_t n_vertices, const double *xy,
                        int64_t n_triangles, const int64_t *vertex_id, double reach) {
  const Cover cover = cover_of_arrays(n_vertices, xy, n_triangles, vertex_id);
  return uncovered_areas(circle(radius, {centre[0], centre[1]}), cover, reach).beyond_reach;
}

double shim_edge_beyond(double radius, const double centre[2], int64_t n_vertices, const double *xy,
                        int64_t n_triangles, const int64_t *vertex_id, double reach) {
  return uncovered_edge(circle(radius, {centre[0], centre[1]}), cover_of_arrays(n_vertices, xy, n_triangles, vertex_id),
                        reach);
}
