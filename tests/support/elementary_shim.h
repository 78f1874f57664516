/* SPDX-License-Identifier: Apache-2.0
 *
 * Lets C code use common/elementary.hpp. The sines, cosines and arc tangents of this header have the same bits on every
 * machine. */
#ifndef RIIS_TESTS_ELEMENTARY_SHIM_H
#define RIIS_TESTS_ELEMENTARY_SHIM_H

#ifdef __cplusplus
extern "C" {
#endif

double shim_sine_of_pi(double u);
double shim_cosine_of_pi(double t);
/* at[0] is the sine, and at[1] the cosine. */
void shim_sine_cosine(double radians, double at[2]);
void shim_sine_cosine_degrees(double degrees, double at[2]);
double shim_arc_tangent(double y, double x);
double shim_arc_cosine(double cosine);
double shim_exponential_minus_one(double x);
double shim_power_to_share(double base, double share);
double shim_cube_root(double x);

#ifdef __cplusplus
}
#endif

#endif
