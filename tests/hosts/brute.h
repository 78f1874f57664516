/* SPDX-License-Identifier: Apache-2.0
 * Computes distances by a loop over all triangles of a surface, for the tests of hosts. The user files of a host mark points by
 * riis, and the marks must follow from the distances of the loop. */
#ifndef RIIS_HOSTS_BRUTE_H
#define RIIS_HOSTS_BRUTE_H

#include <riis/riis.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Gives each point's distance to the surface. Point i is x[i * stride], y[i * stride], z[i * stride]. A point farther than
 * `limit` from the bounds of the surface gets RIIS_FAR_DISTANCE. */
void brute_distances(const riis_surface *surface, int64_t n_points, const double *x, const double *y, const double *z,
                     int64_t stride, double limit, double *distance);

/* For Fortran 77: CALL BRUTE_DISTANCES(SURFACE, N, X, Y, Z, STRIDE, LIMIT, DISTANCE), with the handle of riisf_*. */
void brute_distances_(const int64_t *surface, const int32_t *n_points, const double *x, const double *y,
                      const double *z, const int32_t *stride, const double *limit, double *distance);

#ifdef __cplusplus
}
#endif

#endif
