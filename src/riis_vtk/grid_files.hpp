// SPDX-License-Identifier: Apache-2.0
// In: a path. Out: a VTK data set that has the sizes that the file promised and whose cells name only points that exist. VTK
// reads on after many errors and returns the part that it has. Here a file is whole or an error.
#pragma once

#include <string>

#include <vtkSmartPointer.h>

#include "riis_vtk/vtk_errors.hpp"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace riis::vtk {

// Reads an unstructured grid with at least one point from a .vtu (XML) or .vtk (legacy) file.
vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string &path, const CaughtOutput &caught);

// Reads polydata with at least one point from a .vtp (XML) file. The cells are polygons and strips only.
vtkSmartPointer<vtkPolyData> read_polydata(const std::string &path, const CaughtOutput &caught);

}  // namespace riis::vtk
