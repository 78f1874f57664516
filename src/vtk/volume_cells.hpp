// SPDX-License-Identifier: Apache-2.0
// In: a grid whose cells have been checked. Out: its linear volume cells as plain arrays for riis_adjacency_create_from_cells.
#pragma once

#include <cstdint>
#include <vector>

class vtkUnstructuredGrid;

namespace riis::vtk {

struct VolumeCells {
  std::vector<std::int64_t> node_ids;
  std::vector<std::int64_t> offsets = {0};  // one more than cells
};

// Returns tetrahedra, pyramids, wedges and hexahedra, and voxels as hexahedra. Other cells are left out.
VolumeCells volume_cells_of(vtkUnstructuredGrid *grid);

// Edges of the same cells, as pairs of nodes. An edge of several cells is listed several times.
struct LongEdges {
  std::vector<std::int64_t> node_ids;  // (2, n)
  std::int64_t n_cells_left_out = 0;   // volume cells of other kinds
};

// Returns the edges that are longer than a length and whose bounding box meets the box from lower to upper. The grid's points are
// xyz(3, n).
LongEdges long_edges_of(vtkUnstructuredGrid *grid, const double *xyz, double longer_than, const double *lower,
                        const double *upper);

}  // namespace riis::vtk
