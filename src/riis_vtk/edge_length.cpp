// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/edge_length.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <vtkMath.h>
#include <vtkUnstructuredGrid.h>

#include "riis_vtk/volume_cells.hpp"

namespace riis::vtk {
namespace {

double distance_between(vtkUnstructuredGrid *grid, vtkIdType a, vtkIdType b) {
  double p[3], q[3];
  grid->GetPoint(a, p);
  grid->GetPoint(b, q);
  return std::sqrt(vtkMath::Distance2BetweenPoints(p, q));
}

}  // namespace

double median_edge_of(vtkUnstructuredGrid *grid) {
  constexpr vtkIdType most_cells = 20'000;
  const vtkIdType n_cells = grid->GetNumberOfCells(), n_asked = std::min(n_cells, most_cells);
  CellEdges edges(grid);
  std::vector<double> lengths;
  for (vtkIdType i = 0; i < n_asked; ++i) {
    const vtkIdType cell_id = n_cells / n_asked * i + n_cells % n_asked * i / n_asked;
    edges.for_each(cell_id, [&](vtkIdType a, vtkIdType b) {
      const double length = distance_between(grid, a, b);
      if (length > 0 && std::isfinite(length)) lengths.push_back(length);
    });
  }
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

}  // namespace riis::vtk
