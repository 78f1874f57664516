// SPDX-License-Identifier: Apache-2.0
// In: a surface's triangles, a marked mesh. Out: the two panels of a picture, as VTK renderers without a camera
// position.
#pragma once

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkPolyData;
class vtkRenderer;
class vtkUnstructuredGrid;

namespace riis::vtk {

struct PanelTexts {
  int size, panel_width;  // pixels
  std::string title;
  std::vector<std::string> leaflet_names;  // by leaflet; others are numbered
};

// The surface, each leaflet in its colour, with a key of the colours.
vtkSmartPointer<vtkRenderer> surface_panel(vtkPolyData *surface, const PanelTexts &texts);

// The cells all of whose nodes are marked, each in the colour of its closest node's leaflet, in the faint boundary of
// the mesh. The grid has the marking's point arrays.
vtkSmartPointer<vtkRenderer> marks_panel(vtkUnstructuredGrid *grid, const PanelTexts &texts);

}  // namespace riis::vtk
