// SPDX-License-Identifier: Apache-2.0
// In: the path of a legacy .vtk file. Out: its number of cells, or an error for a file that is not an unstructured grid
// or not complete. VTK's legacy reader believes every count, takes a short file for a smaller one, and ends the process
// on some files. So the sections are walked here before VTK sees them.
#pragma once

#include <cstdint>
#include <string>

namespace riis::vtk {

std::int64_t check_legacy(const std::string &path);

}  // namespace riis::vtk
