// SPDX-License-Identifier: Apache-2.0
// In: a sight in which a mesh goes on beyond the panel. Out: how the mesh is cut so that one sees that it goes on.
#pragma once

#include <vtkPlane.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "vtk/picture_view.hpp"

class vtkPolyData;

namespace riis::vtk {

// For the mapper of what is to be cut; none where the mesh is in sight as a whole.
std::vector<vtkSmartPointer<vtkPlane>> cutting_planes(const View &view, const Sight &sight);

// Dashed lines where the planes cut the boundary, nearer to the eye than all else.
vtkSmartPointer<vtkPolyData> dashes_where_cut(const View &view, const Sight &sight, vtkPolyData *boundary);

}  // namespace riis::vtk
