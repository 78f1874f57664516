// SPDX-License-Identifier: Apache-2.0
// In: a path. Out: a VTK data set whose sizes are those that the file promised and whose cells name only points that
// exist. VTK reads on after many errors and hands out what it has; here a file is whole or an error.
#pragma once

#include <string>

#include <vtkSmartPointer.h>

#include "vtk/vtk_errors.hpp"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace riis::vtk {

// An unstructured grid with at least one point, from .vtu (XML) or .vtk (legacy).
vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string &path, const CaughtOutput &caught);

// Polydata of polygons and strips only, with at least one point, from .vtp (XML).
vtkSmartPointer<vtkPolyData> read_polydata(const std::string &path, const CaughtOutput &caught);

}  // namespace riis::vtk
