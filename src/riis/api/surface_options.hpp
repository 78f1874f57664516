// SPDX-License-Identifier: Apache-2.0
// riis_surface_options: defaults and checks.
#pragma once

#include <riis/riis.h>

#include "common/band.hpp"
#include "geometry/placement.hpp"

namespace riis {

extern const riis_surface_options default_surface_options;

// Both functions fail with RIIS_INVALID_ARGUMENT. `name` is the name of the argument.
void check_placement(const riis_surface_options &options, const char *name);
void check_options(const riis_surface_options &options);

Placement placement_of(const riis_surface_options &options);
double half_thickness_of(const riis_surface_options &options);
Band band_of(const riis_surface_options &options);

}  // namespace riis
