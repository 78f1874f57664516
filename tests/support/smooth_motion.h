/* SPDX-License-Identifier: Apache-2.0
 * Computes the motion of a smooth valve from one state to another, for tests of velocities. The library only provides the valve's
 * curves. The curves' lengths come from a separate quadrature. A search for a point begins at the label (patch, u, v). */
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
/* Gives the positions of the label (patch_id, u, v) in both states. */
void smooth_motion_places(const smooth_motion *motion, int patch_id, const double *uv, double *now, double *before);
/* Finds the point of the smooth patch that is nearest to a given point. Gives the velocity of this point, and returns the
 * distance. The search begins at (u, v). */
double smooth_motion_nearest(const smooth_motion *motion, int patch_id, const double *uv, const double *point,
                             double *velocity);

#ifdef __cplusplus
}
#endif

#endif
