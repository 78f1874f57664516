/* SPDX-License-Identifier: Apache-2.0
 * The motion of a smooth valve from one state to another, for tests of velocities. It takes the valve's curves from the library, and
 * nothing else: lengths along them come from sums of its own, and a place is sought from the label (patch, u, v) on the smooth patch. */
#ifndef RIIS_TEST_SMOOTH_MOTION_H
#define RIIS_TEST_SMOOTH_MOTION_H

#include <riis/riis.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct smooth_motion smooth_motion;
/* Both states are without placement. */
smooth_motion *smooth_motion_create(const riis_valve *now, const riis_valve *before, double seconds);
void smooth_motion_destroy(smooth_motion *motion);
/* Gives the places of the label (patch_id, u, v) in both states. */
void smooth_motion_places(const smooth_motion *motion, int patch_id, const double *uv, double *now, double *before);
/* Gives the velocity of the place of the smooth patch that is nearest to a point, sought from (u, v), and how far it is. */
double smooth_motion_nearest(const smooth_motion *motion, int patch_id, const double *uv, const double *point,
                             double *velocity);

#ifdef __cplusplus
}
#endif

#endif
