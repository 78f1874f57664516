// SPDX-License-Identifier: Apache-2.0
// In: the faces of a wall. Out: a translucent, lit shell that is open at its flat ends, with lines at its rims.
#pragma once

#include <vtkSmartPointer.h>

#include <optional>

#include "riis_vtk/picture/picture_view.hpp"

class vtkActor;
class vtkPolyData;
class vtkRenderer;

namespace riis::vtk {

class Shell {
 public:
  // `faces` is a closed boundary or a wall with openings. `grey` is the brightness of the shell, from 0 to 1. `line` is the
  // colour of the rims, and `pixels` is their width.
  Shell(vtkPolyData *faces, double grey, const Colour &line, double pixels);
  void add_to(vtkRenderer *renderer) const;
  // Turns to a view. The shell is denser where it is seen at a grazing angle. A shell that extends beyond the panel is cut at the
  // panel's side.
  void look(const View &view, const Sight &sight);

 private:
  void sort(const View &view);

  unsigned char grey_;
  vtkSmartPointer<vtkPolyData> faces_;  // with normals at their points
  vtkSmartPointer<vtkActor> skin_, rims_, cut_;
  std::optional<View> sorted_for_;
};

}  // namespace riis::vtk
