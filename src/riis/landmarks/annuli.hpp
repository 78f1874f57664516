// SPDX-License-Identifier: Apache-2.0
// Checks of landmarks along an annulus or along a housing.
#pragma once

#include "geometry/vec3.hpp"
#include "landmarks/landmarks.hpp"

namespace riis {

// Two points of an annulus count as one place if their distance is at most `one_place` times the spread of all points.
inline constexpr double one_place = 1e-3;

// Returns the cosine of the angle between the flow and a normal. Refuses a flow that is nearly perpendicular to the normal.
double checked_flow(const Landmarks &landmarks, Vec3 normal, const char *whose);

}  // namespace riis
