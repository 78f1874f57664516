// SPDX-License-Identifier: Apache-2.0
// In: a grid whose cells have been checked. Out: the edges of its cells, and its linear volume cells as plain arrays for
// riis_adjacency_create_from_cells.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include <vtkNew.h>
#include <vtkType.h>

class vtkDataArray;
class vtkIdList;
class vtkUnstructuredGrid;

namespace riis::vtk {

// The edges of cells with straight sides are their sides. A cell of higher order has the edges of the linear cells that its nodes
// cut it into. A face without a node in its middle has edges between the middles of neighbouring sides.
class CellEdges {
 public:
  using Edge = std::array<vtkIdType, 2>;

  explicit CellEdges(vtkUnstructuredGrid *grid);

  // Tells whether the cell is one of volume. Others bound volumes, or stand alone.
  bool is_volume(vtkIdType cell) const;
  // Calls visit with both nodes of each edge of a face or a volume. Returns false if the edges are not known.
  template <class Visit>
  bool for_each(vtkIdType cell, const Visit &visit) {
    const vtkIdType *ids = nullptr;
    const std::vector<Edge> &edges = pairs_of(cell, ids);
    for (const auto &[a, b] : edges) visit(ids ? ids[a] : a, ids ? ids[b] : b);
    return !edges.empty();
  }

 private:
  // Returns each edge once, as a pair of positions in the list of nodes ids. If ids stays NULL the pairs are nodes.
  const std::vector<Edge> &pairs_of(vtkIdType cell, const vtkIdType *&ids);
  void list_polyhedron(vtkIdType cell);
  const std::vector<Edge> &lattice_of(int type, vtkIdType cell, vtkIdType n_nodes);

  vtkUnstructuredGrid *grid_;
  vtkDataArray *degrees_;  // of cells of higher order; may be NULL
  vtkNew<vtkIdList> faces_;
  std::vector<Edge> edges_;                                   // of a polyhedron
  std::map<std::array<int, 4>, std::vector<Edge>> lattices_;  // by the type and the three orders
};

struct VolumeCounts {
  std::int64_t n_volumes = 0;
  std::int64_t n_linear = 0;   // of these, the cells that volume_cells_of returns
  std::int64_t n_unknown = 0;  // of these, the cells whose edges are not known
};
VolumeCounts count_volumes(vtkUnstructuredGrid *grid);

struct VolumeCells {
  std::vector<std::int64_t> node_ids;
  std::vector<std::int64_t> offsets = {0};  // one more than cells
};

// Returns tetrahedra, pyramids, wedges and hexahedra, and voxels as hexahedra. Other cells are left out.
VolumeCells volume_cells_of(vtkUnstructuredGrid *grid);

// Edges of cells of volume, as pairs of nodes. An edge of several cells is listed several times.
struct VolumeEdges {
  std::vector<std::int64_t> node_ids;  // (2, n)
  std::int64_t n_cells_left_out = 0;   // cells of volume whose edges are not known
};
VolumeEdges volume_edges_of(vtkUnstructuredGrid *grid);

// Returns the edges that are longer than a length and whose bounding box meets the box from lower to upper. The grid's points are
// xyz(3, n).
VolumeEdges long_edges_of(vtkUnstructuredGrid *grid, const double *xyz, double longer_than, const double *lower,
                          const double *upper);

}  // namespace riis::vtk
