// SPDX-License-Identifier: Apache-2.0
// The annulus of the mitral valve, from its sizes (docs/theory/mitral.md). The file mitral.cpp makes the annulus.
#pragma once

#include <array>

#include "geometry/bezier.hpp"

namespace riis {

// The sizes of the annulus: lengths, and the position of the widest point as a share. The names are the parameters' names.
struct MitralAnnulus {
  double AP_diameter, ALPM_diameter, ALPM_position_ratio, IT_distance, indent_depth, anterior_horn_height,
      posterior_horn_height;
};

// Returns the half on the posteromedial side, x >= 0, from the posterior point to the anterior point. The joints of the spans
// are the widest point and the trigone. The other half is the mirror image in x.
std::array<Bezier, 3> half_annulus(const MitralAnnulus &annulus);

}  // namespace riis
