// SPDX-License-Identifier: Apache-2.0
// In: the path of a legacy .vtk file. Out: nothing, or an error for a file that is not an unstructured grid or not
// complete. VTK's legacy reader believes every count, takes a short file for a smaller one, and ends the process on
// some: the sections are walked here before it sees them.
#pragma once

#include <string>

namespace riis::vtk {

void check_legacy(const std::string &path);

}  // namespace riis::vtk
