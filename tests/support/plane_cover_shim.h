/* SPDX-License-Identifier: Apache-2.0
 *
 * Lets C code use measures/plane_cover.hpp, which computes the part of an outline that triangles leave uncovered. */
#ifndef RIIS_TESTS_PLANE_COVER_SHIM_H
#define RIIS_TESTS_PLANE_COVER_SHIM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Return the area of a circle, and the part of it that no triangle covers.
 *   corners  (2, 3, n_triangles) */
double shim_circle_area(double radius, const double centre[2], int64_t n_lines);
double shim_uncovered_circle(double radius, const double centre[2], int64_t n_triangles, const double *corners,
                             int64_t n_lines);

/* Returns the part of the area inside closed lines that no triangle covers. Each line has two points. Returns -1 if the
 * lines are not closed.
 *   points  (3, 2, n_segments) */
double shim_uncovered_inside(int64_t n_segments, const double *points, int64_t n_triangles, const double *corners,
                             int64_t n_lines);

/* The triangles share vertices, and are enlarged by `reach`. Gives the area of the part of the circle that the enlarged triangles
 * leave uncovered, and the length of this part's edge.
 *   xy         (2, n_vertices)
 *   vertex_id  (3, n_triangles) */
double shim_area_beyond(double radius, const double centre[2], int64_t n_vertices, const double *xy,
                        int64_t n_triangles, const int64_t *vertex_id, double reach);
double shim_edge_beyond(double radius, const double centre[2], int64_t n_vertices, const double *xy,
                        int64_t n_triangles, const int64_t *vertex_id, double reach);

#ifdef __cplusplus
}
#endif

#endif
