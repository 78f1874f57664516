// SPDX-License-Identifier: Apache-2.0
#include "vtk/volume_cells.hpp"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkUnstructuredGrid.h>

namespace riis::vtk {
namespace {

bool is_linear_volume(int type) {
  return type == VTK_TETRA || type == VTK_PYRAMID || type == VTK_WEDGE || type == VTK_HEXAHEDRON || type == VTK_VOXEL;
}

}  // namespace

VolumeCells volume_cells_of(vtkUnstructuredGrid *grid) {
  VolumeCells cells;
  const vtkIdType n_cells = grid->GetNumberOfCells();
  std::size_t n_volumes = 0, n_corners = 0;
  for (vtkIdType cell_id = 0; cell_id < n_cells; ++cell_id) {
    if (!is_linear_volume(grid->GetCellType(cell_id))) continue;
    ++n_volumes;
    n_corners += static_cast<std::size_t>(grid->GetCells()->GetCellSize(cell_id));
  }
  cells.offsets.reserve(n_volumes + 1);
  cells.node_ids.reserve(n_corners);
  for (vtkIdType cell_id = 0; cell_id < n_cells; ++cell_id) {
    const int type = grid->GetCellType(cell_id);
    if (!is_linear_volume(type)) continue;
    vtkIdType n = 0;
    const vtkIdType *ids = nullptr;
    grid->GetCells()->GetCellAtId(cell_id, n, ids);
    if (type == VTK_VOXEL) {
      // A voxel's nodes run along x, then y, then z; a hexahedron's round its base and round its top.
      cells.node_ids.insert(cells.node_ids.end(), {ids[0], ids[1], ids[3], ids[2], ids[4], ids[5], ids[7], ids[6]});
    } else {
      cells.node_ids.insert(cells.node_ids.end(), ids, ids + n);
    }
    cells.offsets.push_back(static_cast<std::int64_t>(cells.node_ids.size()));
  }
  return cells;
}

}  // namespace riis::vtk
