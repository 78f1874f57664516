// SPDX-License-Identifier: Apache-2.0
// In: a surface's triangles, a marked mesh. Out: the two panels of a picture, as VTK renderers without a camera
// position.
#pragma once

#include <vtkSmartPointer.h>

class vtkPolyData;
class vtkRenderer;
class vtkUnstructuredGrid;

namespace riis::vtk {

// The surface, each leaflet in its colour, with a key of the colours. text_size in pixels.
vtkSmartPointer<vtkRenderer> surface_panel(vtkPolyData *surface, int text_size);

// The cells all of whose nodes are marked, each in the colour of its closest node's leaflet, in the faint boundary of
// the mesh. The grid has the marking's point arrays.
vtkSmartPointer<vtkRenderer> marks_panel(vtkUnstructuredGrid *grid, int text_size);

}  // namespace riis::vtk
