// SPDX-License-Identifier: Apache-2.0
// Half a semilunar cusp: its curves, the shape to which it opens, and its two patches (docs/theory/aortic.md).
// In: lengths, angles and exponents of one cusp. Out: Bézier curves in the cusp's frame, and patches in a set.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/bezier.hpp"
#include "valve/patches.hpp"
#include "valve/valve.hpp"

namespace riis {

// A horizontal curve of half a cusp. Its profile is x(y) = radius_in + (end.x - radius_in) (y / end.y)^power, from the symmetry
// plane to the end at radius_out and angle. t0 and t3 are the lengths of the end tangents along y.
struct CuspProfile {
  double radius_in, radius_out, angle, power, t0, t3;
};

struct CuspShape {
  double root_radius, leaflet_height, bending_height, xq, zq;
  CuspProfile leaflet, bending;
};

// The parameters that determine how a cusp opens. Kinds of valves with cusps have these parameters at the end of their lists.
struct CuspOpening {
  double radius_ratio;  // the radius of the open free edge at the symmetry plane, divided by the radius of the root
  double expansion;     // outward motion of the commissures, as a share of their radius
};
// Returns the specs of open_radius_ratio and commissure_expansion.
std::array<ParameterSpec, 2> cusp_opening_specs(const CuspOpening &defaults);

// Returns the shape to which the cusp opens. Its free edge and bending curve are parabolas, and its sides are nearly straight.
// The attachment moves outwards in proportion to its height.
CuspShape open_shape(const CuspShape &closed, const CuspOpening &opening);

// The curves of half a cusp, y >= 0, in the cusp's frame. The symmetry plane is y = 0, the root is at z = 0, and z points to the
// aorta.
struct HalfCusp {
  Bezier leaflet, bending, sinus_below, sinus_above, symmetry_below, symmetry_above;
};
HalfCusp half_cusp(const CuspShape &shape);
HalfCusp blend(const HalfCusp &closed, const HalfCusp &open, double opening);
// Returns the derivatives of the control points with respect to the opening.
HalfCusp rate(const HalfCusp &closed, const HalfCusp &open);

// Refuses curves that extend far away. Values that are each acceptable can together make such curves. Examples are a high
// power with a long tangent, and a bending curve near the root. `state` and `cusp` begin the message, for example "" and "the
// right cusp". `also` is the end of the message's list of parameters.
void check_reach(const HalfCusp &half, const CuspShape &shape, const char *state, const char *cusp, const char *also);

// The position of a cusp. The cusp is turned and then shifted. The id of its leaflet also numbers its patches.
struct CuspPlace {
  Rotation turn;
  Vec3 shift;
  std::int32_t leaflet_id;
};
// Adds the lower and the upper patch of half a cusp. At each place, both patches get images for both halves of the cusp, with
// y >= 0 first. The upper patch becomes the last of the set. Its side v1 is the free edge, which ends at the commissure, u = 1.
void add_cusps(PatchSet &set, const HalfCusp &half, const HalfCusp &rate, const Vector<CuspPlace> &places);
inline std::size_t top_patch(const PatchSet &set) { return set.patches.size() - 1; }

// Returns the places of three equal cusps: right, left and non-coronary, turned by 0, 120 and -120 degrees and then shifted.
Vector<CuspPlace> equal_places(Vec3 shift);
// Sews the images of a patch of three equal cusps together. The half y < 0 of each cusp meets the half y >= 0 of the cusp before
// it.
void sew_equal_cusps(PatchSet &set, std::size_t patch, SeamPlace place);

}  // namespace riis
