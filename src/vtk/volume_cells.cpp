// SPDX-License-Identifier: Apache-2.0
#include "vtk/volume_cells.hpp"

#include <algorithm>

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkHexahedron.h>
#include <vtkPyramid.h>
#include <vtkTetra.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVoxel.h>
#include <vtkWedge.h>

namespace riis::vtk {
namespace {

bool is_linear_volume(int type) {
  return type == VTK_TETRA || type == VTK_PYRAMID || type == VTK_WEDGE || type == VTK_HEXAHEDRON || type == VTK_VOXEL;
}

// Points, lines and faces of any order: they bound volumes, or stand alone.
bool has_no_volume(int type) {
  switch (type) {
    case VTK_EMPTY_CELL:
    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
    case VTK_LINE:
    case VTK_POLY_LINE:
    case VTK_TRIANGLE:
    case VTK_TRIANGLE_STRIP:
    case VTK_POLYGON:
    case VTK_PIXEL:
    case VTK_QUAD:
    case VTK_QUADRATIC_EDGE:
    case VTK_QUADRATIC_TRIANGLE:
    case VTK_QUADRATIC_QUAD:
    case VTK_QUADRATIC_POLYGON:
    case VTK_BIQUADRATIC_QUAD:
    case VTK_QUADRATIC_LINEAR_QUAD:
    case VTK_BIQUADRATIC_TRIANGLE:
    case VTK_CUBIC_LINE:
    case VTK_LAGRANGE_CURVE:
    case VTK_LAGRANGE_TRIANGLE:
    case VTK_LAGRANGE_QUADRILATERAL:
    case VTK_BEZIER_CURVE:
    case VTK_BEZIER_TRIANGLE:
    case VTK_BEZIER_QUADRILATERAL:
      return true;
    default:
      return false;
  }
}

// A cell's edges, as pairs of positions in its list of nodes.
struct CellEdges {
  int n;
  const vtkIdType *(*edge)(vtkIdType);
};
CellEdges edges_of(int type) {
  switch (type) {
    case VTK_TETRA:
      return {6, vtkTetra::GetEdgeArray};
    case VTK_PYRAMID:
      return {8, vtkPyramid::GetEdgeArray};
    case VTK_WEDGE:
      return {9, vtkWedge::GetEdgeArray};
    case VTK_HEXAHEDRON:
      return {12, vtkHexahedron::GetEdgeArray};
    case VTK_VOXEL:
      return {12, vtkVoxel::GetEdgeArray};
    default:
      return {0, nullptr};
  }
}

// Checks the length first: in fine meshes no edge is long.
bool is_long_and_near(const double *a, const double *b, double least_square, const double *lower, const double *upper) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  if (x * x + y * y + z * z < least_square) return false;
  for (int i = 0; i < 3; ++i)
    if (std::max(a[i], b[i]) < lower[i] || std::min(a[i], b[i]) > upper[i]) return false;
  return true;
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
      // A voxel's nodes run along x, then y, then z. A hexahedron's nodes run round its base, then round its top.
      cells.node_ids.insert(cells.node_ids.end(), {ids[0], ids[1], ids[3], ids[2], ids[4], ids[5], ids[7], ids[6]});
    } else {
      cells.node_ids.insert(cells.node_ids.end(), ids, ids + n);
    }
    cells.offsets.push_back(static_cast<std::int64_t>(cells.node_ids.size()));
  }
  return cells;
}

LongEdges long_edges_of(vtkUnstructuredGrid *grid, const double *xyz, double longer_than, const double *lower,
                        const double *upper) {
  LongEdges made;
  const double least = longer_than * (1 - 1e-9), least_square = least * least;
  const vtkIdType n_cells = grid->GetNumberOfCells();
  for (vtkIdType cell_id = 0; cell_id < n_cells; ++cell_id) {
    const int type = grid->GetCellType(cell_id);
    const CellEdges edges = edges_of(type);
    if (edges.n == 0) {
      made.n_cells_left_out += !has_no_volume(type);
      continue;
    }
    vtkIdType n = 0;
    const vtkIdType *ids = nullptr;
    grid->GetCells()->GetCellAtId(cell_id, n, ids);
    for (int i = 0; i < edges.n; ++i) {
      const vtkIdType *ends = edges.edge(i);
      const vtkIdType a = ids[ends[0]], b = ids[ends[1]];
      if (is_long_and_near(xyz + 3 * a, xyz + 3 * b, least_square, lower, upper))
        made.node_ids.insert(made.node_ids.end(), {a, b});
    }
  }
  return made;
}

}  // namespace riis::vtk
