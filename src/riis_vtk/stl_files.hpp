// SPDX-License-Identifier: Apache-2.0
// In: the path of an .stl file, ASCII or binary. Out: its triangles as polydata in the file's order, each with three points of
// its own. Merging points would drop triangles and shift the ids of the others.
#pragma once

#include <string>

#include <vtkSmartPointer.h>

#include "riis_vtk/vtk_errors.hpp"

class vtkPolyData;

namespace riis::vtk {

vtkSmartPointer<vtkPolyData> read_stl(const std::string &path, const CaughtOutput &caught);

}  // namespace riis::vtk
