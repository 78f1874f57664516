// SPDX-License-Identifier: Apache-2.0
// In: a grid whose cells have been checked. Out: how long its edges are.
#pragma once

class vtkUnstructuredGrid;

namespace riis::vtk {

// The median of the edges of linear cells, 0 where there is none. An edge counts once for each of its cells. At most 20,000
// cells are looked at, evenly spaced in their order.
double median_edge_of(vtkUnstructuredGrid *grid);

}  // namespace riis::vtk
