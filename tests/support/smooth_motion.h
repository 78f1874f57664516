/* SPDX-License-Identifier: Apache-2.0
 * The motion of a smooth valve from one state to another, for tests of velocities. It takes only the valve's curves from the
 * library. Lengths along them come from sums of its own, and the search for a place begins at the label (patch, u, v). */
#ifndef RIIS_TEST_SMOOTH_MOTION_H
#define RIIS_TEST_SMOOTH_MOTION_H

#include <riis/riis.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct smooth_motion smooth_motion;
/* Both states have no placement. */
smooth_motion *smooth_motion_create(const riis_valve *now, const riis_valve *before, double seconds);
void smooth_motion_destroy(smooth_motion *motion);
/* Gives the places of the label (patch_id, u, v) in both states. */
void smooth_motion_places(const smooth_motion *motion, int patch_id, const double *uv, double *now, double *before);
/* Gives the velocity of the place of the smooth patch that is nearest to a point, and returns their distance. The search begins
 * at (u, v). */
double smooth_motion_nearest(const smooth_motion *motion, int patch_id, const double *uv, const double *point,
                             double *velocity);

#ifdef __cplusplus
}
#endif

#endif
