// SPDX-License-Identifier: Apache-2.0
// In: faces as plain arrays. Out: their connected pieces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "riis_vtk/faces.hpp"

namespace riis::vtk {

// Returns the number of each vertex's place, which is below the number of vertices. Vertices at exactly the same coordinates have
// the same place.
std::vector<std::size_t> places_of(const Faces &faces);

// Returns the piece of every face. Pieces are numbered in the order of their first faces. Faces are connected if they share a
// vertex or have vertices with exactly the same coordinates.
std::vector<std::int32_t> pieces_of(const Faces &faces);

}  // namespace riis::vtk
