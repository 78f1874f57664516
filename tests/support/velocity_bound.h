/* SPDX-License-Identifier: Apache-2.0
 * Bounds the difference between the velocity of a surface's triangles and the velocity of the smooth valve at equal patch, u and
 * v (docs/theory/velocity.md). */
#ifndef RIIS_TEST_VELOCITY_BOUND_H
#define RIIS_TEST_VELOCITY_BOUND_H

#include <riis/riis.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the bound. The arguments are those of the surface's last riis_surface_update_moving. */
double velocity_error_bound(const riis_surface *surface, const riis_valve *valve, const riis_valve *before,
                            double seconds, const riis_surface_options *options_before);

#ifdef __cplusplus
}
#endif

#endif
