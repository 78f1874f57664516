// SPDX-License-Identifier: Apache-2.0
// In: a sight in which a mesh goes on beyond the panel. Out: planes and dashed lines that show that it goes on.
#pragma once

#include <vtkPlane.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "riis_vtk/picture_view.hpp"

class vtkPolyData;

namespace riis::vtk {

// Returns planes for the mapper of the mesh. There are none if the whole mesh is in sight.
std::vector<vtkSmartPointer<vtkPlane>> cutting_planes(const View &view, const Sight &sight);

// Returns dashed lines where the planes cut the boundary. They are nearer to the eye than everything else.
vtkSmartPointer<vtkPolyData> dashes_where_cut(const View &view, const Sight &sight, vtkPolyData *boundary);

}  // namespace riis::vtk
