/* SPDX-License-Identifier: Apache-2.0
 *
 * C wrappers of the program's measurement of the orifice. */
#ifndef RIIS_TESTS_ORIFICE_SHIM_H
#define RIIS_TESTS_ORIFICE_SHIM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Return the area of a circle, and the part of it that no triangle covers.
 *   corners  (2, 3, n_triangles) */
double shim_circle_area(double radius, const double centre[2], int64_t n_lines);
double shim_uncovered_circle(double radius, const double centre[2], int64_t n_triangles, const double *corners,
                             int64_t n_lines);

/* Returns the part of the area inside closed lines, of two points each, that no triangle covers. Returns -1 if the lines are
 * not closed.
 *   points  (3, 2, n_segments) */
double shim_uncovered_inside(int64_t n_segments, const double *points, int64_t n_triangles, const double *corners,
                             int64_t n_lines);

#ifdef __cplusplus
}
#endif

#endif
