// SPDX-License-Identifier: Apache-2.0
// The inputs are the faces of a wall. The result is a translucent shell with lighting. The shell is open at the wall's flat ends,
// and lines show its rims.
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
  // `faces` are the faces of a closed boundary or of a wall with openings. `grey` is the brightness of the shell, from 0 to 1.
  // `line` is the colour of the rims, and `pixels` is their width. `has_dashes` tells whether dashes show where the shell is cut.
  Shell(vtkPolyData *faces, double grey, const Colour &line, double pixels, bool has_dashes);
  void add_to(vtkRenderer *renderer) const;
  // Turns the shell to a view. The shell is more opaque where it is seen at a grazing angle. If the shell extends beyond the
  // panel, it is cut at the panel's side.
  void look(const View &view, const Sight &sight);

 private:
  void sort(const View &view);

  unsigned char grey_;
  bool has_dashes_;
  vtkSmartPointer<vtkPolyData> faces_;  // with normals at their points
  vtkSmartPointer<vtkActor> skin_, rims_, cut_;
  std::optional<View> sorted_for_;
};

}  // namespace riis::vtk
