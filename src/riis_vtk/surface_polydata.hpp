// SPDX-License-Identifier: Apache-2.0
// In: a surface of the core. Out: exactly its triangles, as polydata with double points and the arrays that riis_vtk.h names.
#pragma once

#include <riis/riis.h>

#include <vtkSmartPointer.h>

class vtkPolyData;

namespace riis::vtk {

vtkSmartPointer<vtkPolyData> polydata_of(const riis_surface *surface);

}  // namespace riis::vtk
