// SPDX-License-Identifier: Apache-2.0
// Measures the orifice of a valve. The orifice is the part of an outline that the triangles do not cover, seen along the axis.
// In: the triangles, and the frame of the valve if they come from one. Out: areas and a perimeter, and the sizes of leaflets.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "geometry/placement.hpp"
#include "surface/coaptation.hpp"
#include "surface/triangle_set.hpp"
#include "valve/valve.hpp"

namespace riis {

// The factor c of the effective area A - c eps P. The band around a rim narrows the orifice by the distance c eps. A wall without
// thickness blocks the flow equally if its rim reaches c eps farther into the orifice. Each number lies midway between the c of
// two valves that docs/validation.md compares with walls in body-fitted meshes. The open bileaflet valve has 0.98 (round) and
// 0.95 (cut). The open trileaflet valve has 0.70 and 0.46.
inline constexpr double rim_reach_round = 0.84;  // RIIS_RIM_ROUND
inline constexpr double rim_reach_cut = 0.70;    // RIIS_RIM_CUT

// The placement, the disc, the housing, the skirt and the kind of the valve that a surface was made from.
struct ValveFrame {
  Placement placement;
  Valve::Disc disc;      // before placement
  std::int32_t housing;  // the leaflet_id of the housing, or -1 if the valve has no housing
  std::int32_t skirt;    // the leaflet_id of the skirt, or -1 if the valve has no skirt
  const ValveKind *kind;
  bool is_warped;

  // Returns the unit vector along which the orifice is seen: the z axis, or the normal of a warped disc.
  Vec3 axis() const;
};

// The measured numbers. The caller computes the other fields of riis_orifice from these numbers and the frame.
struct Orifice {
  double area, outline_area, perimeter, effective_area;
  Vec3 axis;             // of length 1, or 0 without an axis
  std::int32_t outline;  // RIIS_OUTLINE_*
};

struct OrificeLimits {
  double reach;  // how far the effective orifice's edge is moved inwards
  double slit;   // how far the perimeter's edge is moved inwards
};

// Measures the orifice. The frame is null for triangles from arrays, whose longest boundary is the outline.
Orifice measure_orifice(const TriangleSet &set, const ValveFrame *frame, const OrificeLimits &limits);

// Returns the leaflets, ascending by id.
std::vector<riis_leaflet> leaflets_of(const TriangleSet &set);

// Returns the straight parts of the leaflets' free edges.
std::vector<EdgePart> free_edge_parts(const TriangleSet &set);

// Returns the area of all leaflets except one.
double area_without(const std::vector<riis_leaflet> &leaflets, std::int32_t leaflet_id);

}  // namespace riis
