// SPDX-License-Identifier: Apache-2.0
// The cuts of a valve's curves at landmarks (docs/theory/warp.md, "Warped valves").
// The landmarks of a map determine where the curves of the patches are cut before they are warped.
#pragma once

#include <cstddef>

#include "base/recycled.hpp"
#include "geometry/curve.hpp"
#include "valve/patches.hpp"
#include "valve/unfolding.hpp"
#include "valve/warp.hpp"

namespace riis {

// The places at which landmarks lie on the curves of a valve. A warped curve is cut there, so that it meets the map's landmarks.
// The places are found on the valve at rest. They therefore depend neither on the warp's targets nor on the opening.
class LandmarkCuts {
 public:
  // Adds the landmarks of a map that lie on the curves of this state. All states must be built alike.
  void add(const PatchSet &state, const WarpMap &map);

  // Returns the cuts on a side of a patch, in ascending order along the side's curve. Patches are numbered as after a warp. The
  // sides are v0, v1, u0 and u1.
  const Vector<PointOnSpan> &on_side(std::size_t patch, std::size_t side) const { return on_sides_[4 * patch + side]; }

 private:
  Vector<Vector<PointOnSpan>> on_sides_;
};

// Returns the cuts of each copy of a curve. Cuts are stored by side, because two patches may share a curve in one state only. A
// copy has the cuts of all sides that use this copy.
Vector<Vector<PointOnSpan>> cuts_by_copy(Unfolding &unfolding, const LandmarkCuts &cuts);

// Returns the spans, or their rates, with each cut span replaced by its parts.
Vector<Bezier> cut_at(const Vector<Bezier> &spans, const Vector<PointOnSpan> &cuts);

}  // namespace riis
