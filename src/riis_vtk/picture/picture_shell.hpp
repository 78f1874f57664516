// SPDX-License-Identifier: Apache-2.0
// In: the faces of a wall. Out: a translucent, lit shell that is open at its flat ends, with lines at its rims.
#pragma once

#include <vtkSmartPointer.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "riis_vtk/picture/picture_view.hpp"

class vtkActor;
class vtkPolyData;
class vtkRenderer;

namespace riis::vtk {

struct FlatParts {
  std::vector<std::uint8_t> is_end;  // for each face, whether it belongs to an end
  bool are_all = false;              // the faces have hardly any other part, as those of a box
};

// Finds the flat ends of a wall: connected faces in one plane that meet the rest of the wall at a sharp rim. The faces must share
// their points.
FlatParts flat_ends(vtkPolyData *faces);

class Shell {
 public:
  // `faces` is a closed boundary or a wall with openings. `line` is the colour of the rims, and `pixels` is their width.
  Shell(vtkPolyData *faces, const Colour &line, double pixels);
  void add_to(vtkRenderer *renderer) const;
  // Turns to a view. The shell is denser where it is seen at a grazing angle. If it extends beyond the panel, it is cut there.
  void look(const View &view, const Sight &sight);

 private:
  void sort(const View &view);

  vtkSmartPointer<vtkPolyData> faces_;  // with normals at their points
  vtkSmartPointer<vtkActor> skin_, rims_, cut_;
  std::optional<View> sorted_for_;
};

}  // namespace riis::vtk
