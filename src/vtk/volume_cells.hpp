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

// Tetrahedra, pyramids, wedges, hexahedra, and voxels as hexahedra; no other cells.
VolumeCells volume_cells_of(vtkUnstructuredGrid *grid);

}  // namespace riis::vtk
