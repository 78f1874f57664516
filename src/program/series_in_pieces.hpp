// SPDX-License-Identifier: Apache-2.0
// A series of a mesh in pieces. Each piece is read once, and its files of all times are written before the next piece is read.
#pragma once

#include "program/case.hpp"
#include "program/mesh_pieces.hpp"
#include "program/refusal.hpp"

namespace riis::program {

// As run_series.
ExitCode run_series_in_pieces(Case &all, const MeshPieces &pieces);

}  // namespace riis::program
