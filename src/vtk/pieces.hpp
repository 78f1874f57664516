// SPDX-License-Identifier: Apache-2.0
// In: faces as plain arrays. Out: the connected pieces that they make.
#pragma once

#include <cstdint>
#include <vector>

#include "vtk/faces.hpp"

namespace riis::vtk {

// The piece of every face, numbered in the order of their first faces. Faces are connected that have a vertex in common, or two with
// exactly the same coordinates.
std::vector<std::int32_t> pieces_of(const Faces &faces);

}  // namespace riis::vtk
