// SPDX-License-Identifier: Apache-2.0
// The orifice of a valve: what its triangles leave uncovered of an outline, seen along the valve's axis.
// In: the triangles, and the frame of the valve. Out: areas and a perimeter, and the sizes of leaflets.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "geometry/placement.hpp"
#include "surface/triangle_set.hpp"
#include "valve/valve.hpp"

namespace riis {

// How far the band around a rim reaches into an orifice, in half thicknesses: the c of A - c eps P. The band blocks the flow as
// far as a wall of no thickness with a rim that much farther out would. The numbers lie midway between the open bileaflet valve
// (0.98 and 0.95), whose leaflets guide the flow, and the open trileaflet valve (0.70 and 0.46), a funnel, beside the same
// leaflets as walls in body-fitted meshes (docs/validation.md).
inline constexpr double rim_reach_round = 0.84;  // RIIS_RIM_ROUND
inline constexpr double rim_reach_cut = 0.70;    // RIIS_RIM_CUT

// The place of the valve that a surface was made from.
struct ValveFrame {
  Placement placement;
  Valve::Disc disc;      // before placement
  std::int32_t housing;  // the leaflet_id of a wall, or -1
};

// The other numbers of riis_orifice follow from these and the frame.
struct Orifice {
  double area, outline_area, perimeter, effective_area;
  std::int32_t outline;  // RIIS_OUTLINE_*
};

struct OrificeLimits {
  double reach;  // how far the effective orifice's edge is moved inwards
  double slit;   // how far the perimeter's edge is moved inwards
};

Orifice measure_orifice(const TriangleSet &set, const ValveFrame &frame, const OrificeLimits &limits);

// Returns the leaflets, ascending by id.
std::vector<riis_leaflet> leaflets_of(const TriangleSet &set);

// Returns the area of all triangles but those of a leaflet.
double area_without(const TriangleSet &set, std::int32_t leaflet_id);

}  // namespace riis
