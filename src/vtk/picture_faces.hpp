// SPDX-License-Identifier: Apache-2.0
// In: a grid, and which of its cells are wanted. Out: the faces that the wanted cells do not share, as polydata.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

class vtkPolyData;
class vtkUnstructuredGrid;

namespace riis::vtk {

// What the cells of a grid are: points, lines, flat cells or volumes. Where there are volumes, flat cells are their boundary or less.
class CellDimensions {
 public:
  explicit CellDimensions(vtkUnstructuredGrid *grid);
  int largest() const { return largest_; }  // 0 to 3
  // Only for types of cells that are in the grid.
  bool is_largest(int type) const { return of_type_[static_cast<std::size_t>(type)] == largest_; }

 private:
  std::array<int, 256> of_type_;
  int largest_ = 0;
};

struct Outside {
  vtkSmartPointer<vtkPolyData> faces;  // with the points that the faces use, no others
  std::vector<vtkIdType> cell_id;      // of each face the cell that it belongs to
  bool of_volumes = false;             // the corners of each face then run against the clock, seen from outside
};

// Volumes give the faces that no other wanted volume has; where the grid has no volumes, flat cells are faces themselves. Other cells
// give none. wanted is by cell; with face_wanted only the faces of such cells are kept. NULL: all.
// Only corners count: faces of cells of higher order are drawn straight.
Outside outside_of(vtkUnstructuredGrid *grid, const std::vector<std::uint8_t> *wanted,
                   const std::vector<std::uint8_t> *face_wanted);

}  // namespace riis::vtk
