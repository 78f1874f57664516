// SPDX-License-Identifier: Apache-2.0
// Measures the orifice of a valve. The orifice is the part of an outline that the triangles do not cover, seen along the axis.
// In: the triangles, and the valve if they come from one. Out: areas and a perimeter.
#pragma once

#include <riis/riis.h>

#include <cstdint>

#include "scene/surface.hpp"

namespace riis {

// The factor c of the effective area A - c eps P. The band around a rim narrows the orifice by the distance c eps. A wall without
// thickness blocks the flow equally if its rim reaches c eps farther into the orifice. Each number lies midway between the c of
// two valves that docs/validation.md compares with walls in body-fitted meshes. The open bileaflet valve has 0.98 (round) and
// 0.95 (cut). The open trileaflet valve has 0.70 and 0.46.
inline constexpr double rim_reach_round = 0.84;  // RIIS_RIM_ROUND
inline constexpr double rim_reach_cut = 0.70;    // RIIS_RIM_CUT

// The measured numbers. The caller computes the other fields of riis_orifice from these numbers and the valve.
struct Orifice {
  double area, outline_area, perimeter, effective_area;
  Vec3 axis;             // of length 1, or 0 without an axis
  std::int32_t outline;  // RIIS_OUTLINE_*
};

struct OrificeLimits {
  double reach;  // how far the effective orifice's edge is moved inwards
  double slit;   // how far the perimeter's edge is moved inwards
};

// Measures the orifice. `source` is null for triangles from arrays, whose longest boundary is the outline.
Orifice measure_orifice(const TriangleSet &set, const SourceValve *source, const OrificeLimits &limits);

}  // namespace riis
