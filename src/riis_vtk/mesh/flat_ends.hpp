// SPDX-License-Identifier: Apache-2.0
// The inputs are the faces of a wall. The results are the wall's flat ends, for example at an inlet.
#pragma once

#include <cstdint>
#include <vector>

class vtkPolyData;

namespace riis::vtk {

struct FlatParts {
  std::vector<std::uint8_t> is_end;  // for each face, whether it belongs to an end
  bool are_all = false;              // hardly any faces belong to no end, as in a box
};

// Finds the flat ends of a wall. A flat end consists of connected faces in one plane that meet the rest of the wall at a sharp
// rim. Neighbouring faces must share their points.
FlatParts flat_ends(vtkPolyData *faces);

}  // namespace riis::vtk
