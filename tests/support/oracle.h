/* SPDX-License-Identifier: Apache-2.0
 * Computes the distance to a triangle independently of the library. The oracle uses Voronoi regions in extended precision, and
 * the library projects in double precision. */
#ifndef RIIS_TEST_ORACLE_H
#define RIIS_TEST_ORACLE_H

#include <stdint.h>

/* Returns the distance from p to the triangle a b c (abc[9]). */
long double oracle_point_triangle(const double *p, const double *abc);

/* Returns the smallest distance from p to n triangles with the vertices vertex_id (3, n) of xyz. *triangle gets the position of
 * the first triangle at this distance. */
long double oracle_distance(const double *p, int64_t n, const int64_t *vertex_id, const double *xyz, int64_t *triangle);

#endif
