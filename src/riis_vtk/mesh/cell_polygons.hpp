// SPDX-License-Identifier: Apache-2.0
// The faces of cells as polygons of corners.
#pragma once

#include <algorithm>
#include <vector>

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include "common/array_view.hpp"
#include "riis_vtk/mesh/mesh.hpp"

namespace riis::vtk {

using Corners = std::vector<vtkIdType>;

// The faces of a grid's cells as polygons of corners. If cells of one type can have different faces, as polyhedra can, this class
// reads each cell's faces from VTK.
class CellPolygons {
 public:
  explicit CellPolygons(vtkUnstructuredGrid *grid) : grid_(grid) {}

  int n_faces_of_volume(vtkIdType cell) {
    const CellShape &shape = shape_of(grid_->GetCellType(cell));
    return shape.faces.empty() ? generic(cell)->GetNumberOfFaces() : static_cast<int>(shape.faces.size());
  }

  // Returns the corners of a face. The result is valid until the next call of this function.
  const Corners &face_of_volume(vtkIdType cell, int face) {
    corners_.clear();
    const CellShape &shape = shape_of(grid_->GetCellType(cell));
    if (shape.faces.empty()) {
      add_corners(generic(cell)->GetFace(face));
      return corners_;
    }
    vtkIdType n = 0;
    const vtkIdType *ids = nullptr;
    grid_->GetCells()->GetCellAtId(cell, n, ids);
    const auto &[nodes, n_corners] = view(shape.faces)[face];
    for (int i = 0; i < n_corners; ++i) corners_.push_back(ids[view(nodes)[i]]);
    return corners_;
  }

  const Corners &flat_cell(vtkIdType cell) {
    corners_.clear();
    const int type = grid_->GetCellType(cell);
    add_corners(generic(cell));
    // Puts the corners in their order round the cell. VTK lists the corners of a pixel row by row, and those of a strip in
    // zigzag.
    if (type == VTK_PIXEL) std::swap(corners_[2], corners_[3]);
    if (type == VTK_TRIANGLE_STRIP) {
      Corners round;
      for (std::size_t i = 0; i < corners_.size(); i += 2) round.push_back(corners_[i]);
      for (std::size_t i = corners_.size() / 2 * 2; i >= 2; i -= 2) round.push_back(corners_[i - 1]);
      corners_ = round;
    }
    return corners_;
  }

 private:
  vtkCell *generic(vtkIdType cell) {
    if (cell != held_) grid_->GetCell(cell, generic_);
    held_ = cell;
    return generic_;
  }

  // Appends the corners of a polygon. The corners come first in the list of its points, and there are as many corners as edges.
  void add_corners(vtkCell *polygon) {
    for (int i = 0; i < polygon->GetNumberOfEdges(); ++i) corners_.push_back(polygon->GetPointIds()->GetId(i));
  }

  vtkUnstructuredGrid *grid_;
  vtkNew<vtkGenericCell> generic_;
  vtkIdType held_ = -1;
  Corners corners_;
};

}  // namespace riis::vtk
