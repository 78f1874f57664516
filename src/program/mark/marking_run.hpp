// SPDX-License-Identifier: Apache-2.0
// The driver of riis mark, surface, check leaks and check crossings. A run is valves x times x pieces: a whole mesh is one piece,
// one state is one time, and the valve of the command line is a case of one. Without a mesh there are no pieces.

//     case -> surfaces -> pieces, read one by one -> marks, leaks, measures -> files -> report
#pragma once

#include "program/base/refusal.hpp"
#include "program/input/case.hpp"
#include "program/mark/mesh_pieces.hpp"
#include "program/output/report.hpp"

namespace riis::program {

// Reads the case or the valve of the options, marks the mesh, writes the files and prints the report. Returns exit_fine, or
// exit_none_marked if no node was marked at any time and the user did not allow that. Throws a Refusal.
ExitCode run_mark(const MarkOptions &options);

// Marks a mesh of the caller's. Checks no options and prints no report. all.options.mesh is the path of the mesh.
Report mark_case(Case &all, const MeshPieces &mesh);

}  // namespace riis::program
