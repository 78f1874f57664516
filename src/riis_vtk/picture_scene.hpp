// SPDX-License-Identifier: Apache-2.0
// The window of a picture, with its panels. It shows one surface and the marks of one grid after the other, and each from any
// side.
#pragma once

#include <riis/riis_vtk.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include "riis_vtk/picture_panels.hpp"
#include "riis_vtk/picture_texts.hpp"
#include "riis_vtk/picture_view.hpp"

class vtkCamera;
class vtkPolyData;
class vtkRenderWindow;
class vtkRenderer;
class vtkUnstructuredGrid;

namespace riis::vtk {

// Edges to draw red. NULL: no word of leaks.
struct Leaks {
  std::int64_t n_edges = 0;
  const std::int64_t *edges = nullptr;
};

// "Surface" if the options have no title.
std::string title_of(const riis_vtk_picture_options &options);

// Fails unless the mesh has the arrays of riis_vtk_mesh_set_marks.
void check_has_marks(const riis_vtk_mesh *mesh);

class Scene {
 public:
  // grid NULL: the surface alone.
  Scene(vtkUnstructuredGrid *grid, const riis_vtk_picture_options &options);
  ~Scene();
  // Shows the surface, and the marks that the grid has now.
  void show(const riis_surface *surface, const std::string &title, const Leaks &leaks);
  // The box that the camera sees, or nothing for the surface.
  vtkRenderWindow *render(std::int32_t view, const std::optional<Bounds> &seen);

 private:
  void add_panel(vtkRenderer *renderer, int panel);

  Layout layout_;
  std::string unit_;  // "" if the caller named none
  std::vector<std::string> leaflet_names_;
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
  vtkSmartPointer<vtkPolyData> triangles_;
  SurfacePanel surface_;
  std::optional<MarksPanel> marks_;
  std::vector<PanelTexts> texts_;
  vtkNew<vtkCamera> camera_;
  vtkNew<vtkRenderWindow> window_;
  vtkSmartPointer<vtkRenderer> behind_;
};

}  // namespace riis::vtk
