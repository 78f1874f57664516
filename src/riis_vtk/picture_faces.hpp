// SPDX-License-Identifier: Apache-2.0
// In: a grid and its wanted cells. Out: polydata of the faces that belong to only one wanted cell.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <array>
#include <cstdint>
#include <vector>

#include "common/array_view.hpp"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace riis::vtk {

// The dimensions of a grid's cells. In a grid with volumes, flat cells repeat the boundary, so they are not drawn.
class CellDimensions {
 public:
  explicit CellDimensions(vtkUnstructuredGrid *grid);
  int largest() const { return largest_; }  // 0 to 3
  // The type must be in the grid.
  bool is_largest(int type) const { return view(of_type_)[type] == largest_; }

 private:
  std::array<int, 256> of_type_;
  int largest_ = 0;
};

struct Outside {
  vtkSmartPointer<vtkPolyData> faces;  // with only the points that the faces use
  std::vector<vtkIdType> cell_id;      // for each face, the cell that it belongs to
  bool of_volumes = false;             // if true, corners run anticlockwise, seen from outside
};

// Each volume gives the faces that no other wanted volume has. In a grid without volumes, each flat cell is a face.
// Faces of cells of higher order become straight between their corners.
//   wanted       one entry per cell; NULL: all
//   face_wanted  one entry per cell: only faces of these cells are kept; NULL: all
Outside outside_of(vtkUnstructuredGrid *grid, const std::vector<std::uint8_t> *wanted,
                   const std::vector<std::uint8_t> *face_wanted);

}  // namespace riis::vtk
