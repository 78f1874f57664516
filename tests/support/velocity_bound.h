/* SPDX-License-Identifier: Apache-2.0
 * Bounds the difference between the velocities of a surface's triangles and those of the smooth valve
 * (docs/theory/velocity.md), at equal patch, u and v. */
#ifndef RIIS_TEST_VELOCITY_BOUND_H
#define RIIS_TEST_VELOCITY_BOUND_H

#include <riis/riis.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the bound. The arguments are those of the last riis_surface_update_moving of the surface. */
double velocity_error_bound(const riis_surface *surface, const riis_valve *valve, const riis_valve *before,
                            double seconds, const riis_surface_options *options_before);

#ifdef __cplusplus
}
#endif

#endif
