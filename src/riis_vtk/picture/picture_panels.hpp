// SPDX-License-Identifier: Apache-2.0
// In: a surface's triangles, a marked mesh. Out: the two panels of a picture. They are made once for all views.
#pragma once

#include <set>

#include <vtkRenderer.h>

#include "riis_vtk/picture/picture_view.hpp"

class vtkActor;
class vtkUnstructuredGrid;

namespace riis::vtk {

// Red, green and blue, each from 0 to 1.
using Colour = std::array<double, 3>;

Colour colour_of_leaflet(vtkIdType leaflet);
// A dark red, which no colour vision confuses with the leaflets' vermilion.
constexpr Colour leak_colour = {0.55, 0.0, 0.0};
constexpr Colour grey = {0.2, 0.2, 0.2};

// The panel with the surface, in which each leaflet has its own colour. The rims are drawn as lines, because faces that are seen
// edge-on cover no pixels.
class SurfacePanel {
 public:
  // `pixels` is the width of a line.
  explicit SurfacePanel(double pixels);
  // Replaces the surface that was shown before.
  void show(vtkPolyData *surface);
  // Turns to a view. The lines are drawn slightly behind the faces, so that nearer faces hide the lines.
  void look(const View &view, const Sight &sight);
  vtkRenderer *renderer() const { return renderer_; }
  const std::set<vtkIdType> &leaflets() const { return leaflets_; }

 private:
  vtkSmartPointer<vtkRenderer> renderer_;
  double pixels_;
  vtkSmartPointer<vtkActor> rims_;
  std::set<vtkIdType> leaflets_;
};

struct MarkCounts {
  vtkIdType n_nodes = 0, n_marked_nodes = 0;
  vtkIdType n_whole_cells = 0;   // cells with all nodes marked
  vtkIdType n_partly_cells = 0;  // cells with some but not all nodes marked
};

// The panel with marked cells inside the faint boundary of the mesh. A cell has the colour of its closest node's leaflet, and a
// partly marked cell is paler. Leaking edges are red. Cells below the grid's largest dimension are left out.
class MarksPanel {
 public:
  // `pixels` is the width of a line.
  MarksPanel(vtkUnstructuredGrid *grid, double pixels);
  // Replaces the marks that were shown before by those in the grid's point arrays. leaking_edges(2, n_leaking_edges) must hold
  // valid node ids.
  void show(vtkUnstructuredGrid *grid, std::int64_t n_leaking_edges, const std::int64_t *leaking_edges);
  vtkRenderer *renderer() const { return renderer_; }
  const MarkCounts &counts() const { return counts_; }
  // Turns to a view. Cuts a mesh that extends beyond the panel, and moves leaking edges in front of everything else.
  void look(const View &view, const Sight &sight);

 private:
  void add_marks(vtkUnstructuredGrid *grid);
  void add_leaks(vtkUnstructuredGrid *grid, std::int64_t n, const std::int64_t *edges);
  void add_outline(vtkUnstructuredGrid *grid);

  vtkSmartPointer<vtkRenderer> renderer_;
  MarkCounts counts_;
  double pixels_;
  double partly_length_ = 0;                                                 // mean edge length of partly marked cells
  vtkSmartPointer<vtkActor> partly_, whole_, leaks_, skin_, outline_, cut_;  // leaks_ is NULL without leaking edges
};

}  // namespace riis::vtk
