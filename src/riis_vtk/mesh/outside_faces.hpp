// SPDX-License-Identifier: Apache-2.0
// The inputs are a grid, and the cells that are wanted. The result is polydata with the faces that belong to exactly one wanted
// cell.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <cstdint>
#include <vector>

#include "common/array_view.hpp"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace riis::vtk {

// Returns the largest dimension of the grid's cells, from 0 to 3. In a grid with volumes, flat cells are not drawn, because they
// only repeat the boundary of the volumes.
int largest_dimension(vtkUnstructuredGrid *grid);

struct Outside {
  vtkSmartPointer<vtkPolyData> faces;  // has only the points that the faces use
  std::vector<vtkIdType> cell_id;      // for each face, its cell
  bool of_volumes = false;             // if true, the corners of a face run anticlockwise, seen from outside
};

// Returns the faces that belong to exactly one of the wanted volumes. In a grid without volumes, each flat cell is a face. The
// faces of cells of higher order become straight between their corners.
//   wanted       for each cell, whether it is wanted; NULL if all cells are wanted
//   face_wanted  for each cell, whether its faces are kept; NULL if all faces are kept
Outside outside_of(vtkUnstructuredGrid *grid, const std::vector<std::uint8_t> *wanted,
                   const std::vector<std::uint8_t> *face_wanted);

}  // namespace riis::vtk
