// SPDX-License-Identifier: Apache-2.0
#include "elementary_shim.h"

#include "common/elementary.hpp"

using namespace riis;

namespace {

void write(SineCosine of, double at[2]) { at[0] = of.sine, at[1] = of.cosine; }

}  // namespace

double shim_sine_of_pi(double u) { return sine_of_pi(u); }
double shim_cosine_of_pi(double t) { return cosine_of_pi(t); }
void shim_sine_cosine(double radians, double at[2]) { write(sine_cosine(radians), at); }
void shim_sine_cosine_degrees(double degrees, double at[2]) { write(sine_cosine_degrees(degrees), at); }
double shim_arc_tangent(double y, double x) { return arc_tangent(y, x); }
double shim_arc_cosine(double cosine) { return arc_cosine(cosine); }
double shim_exponential_minus_one(double x) { return exponential_minus_one(x); }
double shim_power_to_share(double base, double share) { return power_to_share(base, share); }
double shim_cube_root(double x) { return cube_root(x); }
