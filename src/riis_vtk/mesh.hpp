// SPDX-License-Identifier: Apache-2.0
// The content of the opaque mesh handle.
#pragma once

#include <riis/riis_vtk.h>

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

struct riis_vtk_mesh {
  vtkSmartPointer<vtkUnstructuredGrid> grid;  // its points are a vtkDoubleArray
};
