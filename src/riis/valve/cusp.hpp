// SPDX-License-Identifier: Apache-2.0
// Half a semilunar cusp: its curves, the shape to which it opens, and its two patches (docs/theory/aortic.md). The lengths,
// angles and exponents of a cusp give Bézier curves in the cusp's frame. From these curves, this file makes patches.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "geometry/bezier.hpp"
#include "valve/patches.hpp"
#include "valve/valve.hpp"

namespace riis {

// A horizontal curve of half a cusp. The curve's profile is x(y) = radius_in + (end.x - radius_in) (y / end.y)^power, from the
// symmetry plane to the end at radius_out and angle. The numbers t0 and t3 are the lengths of the end tangents along y.
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

// Returns the shape to which the cusp opens. In this shape, the free edge and the bending curve are parabolas, and the sides are
// nearly straight. The attachment moves outwards in proportion to its height.
CuspShape open_shape(const CuspShape &closed, const CuspOpening &opening);

// The curves of half a cusp, y >= 0, in the cusp's frame. The symmetry plane is y = 0, the root is at z = 0, and z points to the
// aorta.
struct HalfCusp {
  Bezier leaflet, bending, sinus_below, sinus_above, symmetry_below, symmetry_above;
  std::optional<Bezier> sinus_start = {};  // a piece of the attachment before sinus_below
};
HalfCusp half_cusp(const CuspShape &shape);
HalfCusp blend(const HalfCusp &closed, const HalfCusp &open, double opening);
// Returns the derivatives of the control points with respect to the opening, from two states whose openings differ by `apart`.
HalfCusp rate(const HalfCusp &closed, const HalfCusp &open, double apart = 1);

// Refuses curves that extend far away. Such curves can arise from values that are each within their range, for example a high
// power with a long tangent. `state` and `cusp` begin the message, for example "" and "the right cusp". `also` ends the list of
// parameters in the message.
void check_reach(const HalfCusp &half, const CuspShape &shape, const char *state, const char *cusp, const char *also);

// The position of a cusp. The cusp is turned and then shifted. The id of its leaflet also determines the ids of its patches.
struct CuspPlace {
  Rotation turn;
  Vec3 shift;
  std::int32_t leaflet_id;
};

// The parts of half a cusp, which lie side by side from the symmetry plane to the commissure, with the rates of their curves. The
// sinus curves of a part are the symmetry curves of the next part.
struct MovingHalf {
  Vector<HalfCusp> parts, rates;
};

// Adds the lower and the upper patch of each part. At each place of a cusp, every patch gets two images, for the half y >= 0 and
// then for the other half. The upper patch of the last part becomes the last patch of the set. The side v1 of this last patch is
// the free edge, which ends at the commissure (u = 1). If the halves have second parts, the ids of the patches of second parts
// come after the ids of all patches of first parts.
void add_cusps(PatchSet &set, const MovingHalf &half, const Vector<CuspPlace> &places);
inline std::size_t top_patch(const PatchSet &set) { return set.patches.size() - 1; }

// Returns the places of equal cusps. The first cusp is at the x axis, the others follow around the z axis, and then all are
// shifted.
Vector<CuspPlace> equal_places(std::size_t n_cusps, Vec3 shift);
// Sews together the images that a patch has in equal cusps. The half y < 0 of each cusp meets the half y >= 0 of the cusp before
// it.
void sew_equal_cusps(PatchSet &set, std::size_t patch, SeamPlace place);

// A cusp that differs from its neighbours, or whose two halves differ. Each half is given as if it were the half y >= 0.
struct UnequalCusp {
  double turn_degrees;
  std::array<MovingHalf, 2> halves;
};
// Adds the patches of cusps that follow each other around the axis. The ids are those that equal cusps would have. To the last
// bit, the halves of a cusp share their middle, and neighbours share their commissure.
void add_unequal_cusps(PatchSet &set, const Vector<UnequalCusp> &cusps, Vec3 shift);

}  // namespace riis
