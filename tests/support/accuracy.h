/* SPDX-License-Identifier: Apache-2.0
 * Lets C code use the points of known distance that bench/accuracy makes. */
#ifndef RIIS_TEST_ACCURACY_H
#define RIIS_TEST_ACCURACY_H

#include <riis/riis.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct known_points {
  int64_t n;
  double *xyz, *distance; /* xyz (3, n), distance (n) */
} known_points;
typedef struct known_truth {
  known_points on, off;
  int64_t n_curved, n_nearer;
  double most_from_fine;
} known_truth;

/* Makes points whose distance to the patches is known. If patches is NULL, uses leaflet 0 of the valve of the given kind.
 * Returns 0, or 1 with the reason on stderr. */
int truth_of(const riis_patches *patches, const char *kind, int64_t n, uint64_t seed, double fine_tolerance,
             known_truth *truth);
void truth_free(known_truth *truth);

/* Offsets are in half thicknesses. Each kept point i has the offset number i modulo n_offsets. */
enum { n_offsets = 6 };
double truth_offset(int64_t i);
double truth_largest_share_of_radius(void);

/* Writes the point (u, v) of patch 0. */
int smooth_point(const riis_patches *patches, double u, double v, double *point, double *normal, double *curvature);

#ifdef __cplusplus
}
#endif
#endif
