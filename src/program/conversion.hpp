// SPDX-License-Identifier: Apache-2.0
// In: a file that cannot be read as it is. Out: the command that makes a readable file of it.
#pragma once

#include <string>

namespace riis::program {

enum class Content { mesh, surface };

// Such as "; gmsh converts it: gmsh -save in.msh -format vtk -o in.vtk". It is "" for an ending that can be read or is
// unknown.
std::string conversion_hint(const std::string &path, Content wanted);

}  // namespace riis::program
