// SPDX-License-Identifier: Apache-2.0
// In: a grid whose cells have been checked. Out: the typical length of its edges.
#pragma once

class vtkUnstructuredGrid;

namespace riis::vtk {

// Returns the median length of the edges of faces and volumes, or 0 if none is known. An edge counts once for each of its cells.
// At most 20,000 cells are used, evenly spaced in their order.
double median_edge_of(vtkUnstructuredGrid *grid);

}  // namespace riis::vtk
