// SPDX-License-Identifier: Apache-2.0
#include "vtk/edge_length.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <vtkCellType.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

namespace riis::vtk {
namespace {

// Tells whether VTK's edges of such a cell serve here. Those of other cells are useless, or not safe to query.
bool has_straight_edges(int type) {
  switch (type) {
    case VTK_TRIANGLE:
    case VTK_QUAD:
    case VTK_PIXEL:
    case VTK_TETRA:
    case VTK_PYRAMID:
    case VTK_WEDGE:
    case VTK_HEXAHEDRON:
    case VTK_VOXEL:
      return true;
    default:
      return false;
  }
}

void add_edges(vtkUnstructuredGrid *grid, vtkIdType cell_id, vtkGenericCell *cell, std::vector<double> &lengths) {
  grid->GetCell(cell_id, cell);
  for (int i = 0; i < cell->GetNumberOfEdges(); ++i) {
    vtkIdList *ends = cell->GetEdge(i)->GetPointIds();
    double a[3], b[3];
    grid->GetPoint(ends->GetId(0), a);
    grid->GetPoint(ends->GetId(1), b);
    const double length = std::sqrt(vtkMath::Distance2BetweenPoints(a, b));
    if (length > 0 && std::isfinite(length)) lengths.push_back(length);
  }
}

}  // namespace

double median_edge_of(vtkUnstructuredGrid *grid) {
  constexpr vtkIdType most_cells = 20'000;
  const vtkIdType n_cells = grid->GetNumberOfCells(), n_asked = std::min(n_cells, most_cells);
  vtkNew<vtkGenericCell> cell;
  std::vector<double> lengths;
  for (vtkIdType i = 0; i < n_asked; ++i) {
    const vtkIdType cell_id = n_cells / n_asked * i + n_cells % n_asked * i / n_asked;
    if (has_straight_edges(grid->GetCellType(cell_id))) add_edges(grid, cell_id, cell, lengths);
  }
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

}  // namespace riis::vtk
