/* SPDX-License-Identifier: Apache-2.0
 * Computes distances by a loop over all triangles of a surface. */
#include "brute.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "oracle.h"

static void stop_on_error(riis_status status) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "brute_distances: %s: %s\n", riis_status_name(status), riis_last_error());
  exit(1);
}

void brute_distances(const riis_surface *surface, int64_t n_points, const double *x, const double *y, const double *z,
                     int64_t stride, double limit, double *distance) {
  riis_triangles triangles;
  riis_surface_info info;
  int64_t nearest;
  stop_on_error(riis_surface_get_triangles(surface, &triangles, sizeof triangles));
  stop_on_error(riis_surface_get_info(surface, &info, sizeof info));
  for (int64_t i = 0; i < n_points; ++i) {
    const double point[3] = {x[i * stride], y[i * stride], z[i * stride]};
    int is_near = 1;
    for (int c = 0; c < 3; ++c)
      is_near = is_near && point[c] >= info.lower[c] - limit && point[c] <= info.upper[c] + limit;
    distance[i] = RIIS_FAR_DISTANCE;
    if (is_near)
      distance[i] = (double)oracle_distance(point, triangles.n_triangles, triangles.vertex_id, triangles.xyz, &nearest);
  }
}

void brute_distances_(const int64_t *surface, const int32_t *n_points, const double *x, const double *y,
                      const double *z, const int32_t *stride, const double *limit, double *distance) {
  brute_distances((const riis_surface *)(intptr_t)*surface, *n_points, x, y, z, *stride, *limit, distance);
}
