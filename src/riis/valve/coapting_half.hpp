// SPDX-License-Identifier: Apache-2.0
// The curves of half a coapting cusp (docs/theory/coapting.md).
// The curves follow from the numbers of the half and the depth of its free edge, and have no crease along the coaptation line.
#pragma once

#include "base/recycled.hpp"
#include "valve/cusp.hpp"
#include "valve/cusp_numbers.hpp"

namespace riis {

// The middle of the free edge hangs `depth` below the edge's end, at the height `low`. `low` could be computed from `depth`. It
// is an argument so that both halves of a cusp have the same height to the last bit. Returns one part or, if the half is fused,
// the free and the fused part.
Vector<HalfCusp> coapting_half(const HalfNumbers &numbers, double depth, double low);

// Returns the least rise of the leaflet at the root. The unit is the rise of a leaflet without sag that is everywhere as long as
// the symmetry curve. With a negative rise, the leaflet dips below its attachment and folds.
double rise_at_root(const Vector<HalfCusp> &parts);

}  // namespace riis
