// SPDX-License-Identifier: Apache-2.0
// The inputs are a mesh with a velocity, and a surface. The result is a panel with the speed in the plane of a view through the
// middle of the surface. Lines show the wall and the leaflets where the plane cuts them.
#pragma once

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

#include "riis_vtk/picture/picture_view.hpp"

class vtkActor;
class vtkPolyData;
class vtkRenderer;
class vtkUnstructuredGrid;
struct riis_vtk_mesh;

namespace riis::vtk {

// A velocity at the nodes of a mesh.
struct Flow {
  vtkSmartPointer<vtkUnstructuredGrid> grid;  // its only point array is the velocity
  std::string unit;                           // the unit of the velocity; "" if the file states none
  std::string time;                           // the folder of a time of OpenFOAM; "" for other files
};

// Finds the velocity by the name of a point array or cell array with three components. If the mesh was read from a time of
// OpenFOAM, the velocity may also be a field of this time. Values of cells are averaged at the nodes. Fails if the mesh has no
// velocity of this name.
Flow flow_of(const riis_vtk_mesh &mesh, const std::string &name);

// Returns the colour of a speed. `share` is the speed divided by the speed at the upper end of the bar of colours.
Colour colour_of_speed(double share);

// Returns the valve's axes after a turn about their z. The plane of RIIS_VTK_VIEW_VALVE_LONG then passes near the centres of two
// leaflets. This plane contains the middle of the surface.
Axes axes_through_two_leaflets(vtkPolyData *surface, const Axes &valve);

class FlowPanel {
 public:
  // `wall` has the faces of the mesh's boundary, and `line` is the colour of the wall's line.
  FlowPanel(const Flow &flow, vtkPolyData *wall, const Colour &line);
  // Replaces the surface that was shown before. The bar of colours then ends at the fastest speed in the planes of the views.
  void show(vtkPolyData *surface, const std::vector<View> &views);
  void look(const View &view, const Sight &sight);
  vtkRenderer *renderer() const { return renderer_; }
  // The speed at the upper end of the bar, which is a round number, and the fastest speed in the planes.
  double upper_end() const { return upper_end_; }
  double fastest() const { return fastest_; }
  const std::string &unit() const { return flow_.unit; }
  const std::string &time() const { return flow_.time; }

 private:
  // Returns the cut of the plane through the mesh, with the speed at its points.
  vtkSmartPointer<vtkPolyData> plane_of(const View &view) const;

  Flow flow_;
  Vector middle_ = {0, 0, 0};
  double upper_end_ = 1, fastest_ = 0;
  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkPolyData> faces_, surface_;
  vtkSmartPointer<vtkActor> plane_, wall_, around_leaflets_, leaflets_;
};

}  // namespace riis::vtk
