// SPDX-License-Identifier: Apache-2.0
// The annulus of the atrioventricular valves (docs/theory/atrioventricular.md, "Annulus").
// The annulus consists of four cubics, which follow from its sizes.
#pragma once

#include <array>

#include "geometry/bezier.hpp"

namespace riis {

// The side towards the other ventricle is flat: the anterior side of the mitral valve, and the septal side of the tricuspid.
enum class FlatSide : bool { at_negative_y, at_positive_y };

struct SaddleAnnulus {
  double width, depth;   // along x and along y
  double flatness;       // 0 for an ellipse, 1 for a D
  double saddle_height;  // from the lowest to the highest points
  FlatSide flat_side;
};

// Returns the annulus. It starts at the middle of the flat side and runs counter-clockwise, seen from +z.
std::array<Bezier, 4> saddle_annulus(const SaddleAnnulus &annulus);

}  // namespace riis
