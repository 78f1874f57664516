// SPDX-License-Identifier: Apache-2.0
// In: the path of a mesh. Out: the mesh. Formats whose readers a damaged file can crash are read in a child process.
#pragma once

#include <string>

#include "program/handles.hpp"

namespace riis::program {

// Reads a mesh. Prints the reader's notes on stderr, unless `quiet`.
MeshFile read_mesh_file(const std::string &path, bool quiet);

// Returns whether the path is the folder of a case of OpenFOAM.
bool is_foam_case(const std::string &path);
// Returns whether the path is the folder of a time of such a case. The folder may be missing.
bool is_foam_time(const std::string &path);
// Returns the path of a time's folder in a case.
std::string foam_time(const std::string &foam_case, double time);

}  // namespace riis::program
