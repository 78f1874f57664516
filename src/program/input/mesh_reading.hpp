// SPDX-License-Identifier: Apache-2.0
// In: the path of a mesh. Out: the mesh. Formats whose readers a damaged file can crash are read in a child process.
#pragma once

#include <string>
#include <vector>

#include "program/base/handles.hpp"

namespace riis::program {

// Reads a mesh. Keeps the reader's note, such as that the file has single precision, for the summary. `cells_where` chooses
// cells, unless it is "".
MeshFile read_mesh_file(const std::string &path, const std::string &cells_where);
// Returns a sentence about domains that touch, if a cell array tells them apart, or "".
std::string text_of_regions(const std::string &path, riis_vtk_mesh *mesh);
// Returns the files that an .xdmf file takes numbers from, as far as they exist, and none for other files.
std::vector<std::string> data_files_of(const std::string &path);
// Returns the lines of the notes since the last call, for the beginning of the summary.
std::string take_notes();

// Returns whether the path is the folder of a case of OpenFOAM.
bool is_foam_case(const std::string &path);
// Returns whether the path is the folder of a time of such a case. The folder may be missing.
bool is_foam_time(const std::string &path);
// Returns the path of a time's folder in a case.
std::string foam_time(const std::string &foam_case, double time);

}  // namespace riis::program
