// SPDX-License-Identifier: Apache-2.0
// The input is the path of a mesh, and the result is the mesh. A child process reads the formats in which a damaged file can
// crash the reader.
#pragma once

#include <string>
#include <vector>

#include "program/base/handles.hpp"

namespace riis::program {

// Reads a mesh. The reader may give a note, for example that the file has single precision. The note is kept for the summary.
// `cells_where` chooses cells of the mesh. "" chooses all cells.
MeshFile read_mesh_file(const std::string &path, const std::string &cells_where);
// If domains of the mesh touch, returns a sentence about them. Returns "" if no cell array tells domains apart.
std::string text_of_regions(const std::string &path, riis_vtk_mesh *mesh);
// Returns the existing files from which an .xdmf file takes its numbers. For files of other formats, returns an empty list.
std::vector<std::string> data_files_of(const std::string &path);
// Returns the notes that were kept since the last call, as lines for the beginning of the summary.
std::string take_notes();

// Returns whether the path is the folder of an OpenFOAM case.
bool is_foam_case(const std::string &path);
// Returns whether the path is the folder of a time in an OpenFOAM case. The folder need not exist.
bool is_foam_time(const std::string &path);
// Returns the path of a time's folder in an OpenFOAM case.
std::string foam_time(const std::string &foam_case, double time);

}  // namespace riis::program
