// SPDX-License-Identifier: Apache-2.0
// The mesh handle holds a grid.
// In: a grid whose cells are checked. Out: the edges of the mesh's cells, the typical length of these edges, and the mesh's
// linear volume cells as plain arrays for riis_adjacency_create_from_cells.
#pragma once

#include <riis/riis_vtk.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include "riis_vtk/read/structured_files.hpp"

class vtkUnsignedCharArray;

namespace riis::vtk {

// The centres of all cells, xyz(3, n_cells), and the pairs of cells that share a face, (2, n_pairs).
struct CellCenters {
  std::vector<double> xyz;
  std::vector<std::int64_t> pairs;
};
CellCenters centers_of(vtkUnstructuredGrid *grid);

// A named value of a cell array, such as one of gmsh's physical groups.
struct RegionName {
  double number;
  std::string name;
};

// The values of a cell array that tells the domains of a mesh, or none.
struct Regions {
  std::string array = {};
  std::vector<double> values = {};
};

}  // namespace riis::vtk

struct riis_vtk_mesh {
  // Its points are a vtkDoubleArray. A grid of axes at first has only arrays: grid() makes its points and cells.
  vtkSmartPointer<vtkUnstructuredGrid> data;
  std::unique_ptr<const riis::vtk::GridAxes> axes = {};
  std::string notes = {};      // the notes that riis_vtk_mesh_get_notes gives
  std::string foam_case = {};  // the folder of the case that the mesh was read from, or ""
  // Centres, if any, are the mesh's nodes, and data of nodes is then data of cells.
  std::unique_ptr<const riis::vtk::CellCenters> centers = {};
  std::vector<riis::vtk::RegionName> region_names = {};  // of gmsh's physical groups of volumes
  riis::vtk::Regions regions = {};                       // as riis_vtk_mesh_find_regions found them
  // If only a part of the cells was kept, the ids of its nodes and cells in the whole mesh. Otherwise empty.
  std::vector<std::int64_t> whole_node_ids = {}, whole_cell_ids = {};

  std::int64_t n_nodes() const { return centers ? n_cells() : axes ? axes->n_nodes() : data->GetNumberOfPoints(); }
  std::int64_t n_cells() const { return axes ? axes->n_cells() : data->GetNumberOfCells(); }
  // Whether the nodes lie on axes.
  bool is_of_axes() const { return axes && !centers; }
  vtkDataSetAttributes *node_data() const;
  void make_points() const;           // of axes, unless they are made
  vtkUnstructuredGrid *grid() const;  // with points and cells
};

namespace riis::vtk {

// As median_edge_of, for the cells of axes.
double median_edge_of(const GridAxes &axes);
// Returns the adjacency of the grid's nodes.
riis_adjacency *adjacency_of(const GridAxes &axes, std::int32_t n_threads);
// Sets is_outside to 0 for points that are at most the distance away from the box of the axes.
void find_outside(const GridAxes &axes, std::int64_t n_points, const double *xyz, double distance,
                  std::uint8_t *is_outside);
// Writes the arrays on the axes to a .vtr file, or on an image to a .vti file.
void write_axes(const std::string &path, const riis_vtk_mesh &mesh, const CaughtOutput &caught);

// Gives the grid points in double precision. A grid without points gets an empty list.
void make_points_double(vtkUnstructuredGrid *grid);

// The properties that all cells of one VTK type have in common. Nodes are positions in the cell's list of nodes. Edges and faces
// are empty for types whose cells differ in them.
using Edge = std::array<vtkIdType, 2>;
struct CellShape {
  struct Face {
    std::vector<vtkIdType> nodes;  // the corners come first, anticlockwise seen from outside
    int n_corners;
  };
  int dimension = 0;
  std::vector<Edge> edges;  // of a face or a volume
  std::vector<Face> faces;  // of a volume
};
const CellShape &shape_of(int type);

struct VolumeCounts {
  std::int64_t n_volumes = 0;
  std::int64_t n_linear = 0;   // the volume cells that volume_cells_of returns
  std::int64_t n_unknown = 0;  // the volume cells whose edges are not known
};
// `ghosts`, by cell, may be NULL. Cells that `ghosts` marks as copies of another piece's cells do not count.
VolumeCounts count_volumes(vtkUnstructuredGrid *grid, vtkUnsignedCharArray *ghosts = nullptr);

struct VolumeCells {
  std::vector<std::int64_t> node_ids;
  std::vector<std::int64_t> offsets = {0};  // the number of cells plus one entries
};

// Returns tetrahedra, pyramids, wedges and hexahedra, and also voxels as hexahedra. Leaves out other cells.
VolumeCells volume_cells_of(vtkUnstructuredGrid *grid);

// Edges of volume cells, as pairs of nodes. An edge appears once for each of its cells.
struct VolumeEdges {
  std::vector<std::int64_t> node_ids;  // (2, n)
  std::int64_t n_cells_left_out = 0;   // volume cells whose edges are not known
};
VolumeEdges volume_edges_of(vtkUnstructuredGrid *grid);

// The edges that are longer than a length, and whose bounding box meets the box from lower to upper.
struct LongEdges {
  LongEdges(double longer_than, const double *box_lower, const double *box_upper)
      : least_square(longer_than * (1 - 1e-9) * (longer_than * (1 - 1e-9))), lower(box_lower), upper(box_upper) {}
  // Compares the length first, because few edges of a fine mesh are long.
  bool has(const double *a, const double *b) const;

  double least_square;
  const double *lower, *upper;
};
// xyz(3, n) are the grid's points.
VolumeEdges long_edges_of(vtkUnstructuredGrid *grid, const double *xyz, const LongEdges &wanted);

// Returns the median, or 0 for no lengths.
double median_of(std::vector<double> lengths);
inline constexpr std::int64_t most_measured =
    20'000;  // cells or pairs of cells that a median is of, at equal distances in the list

// Returns the median length of the edges of faces and volumes, or 0 if no edge is known. An edge counts once for each of its
// cells.
double median_edge_of(vtkUnstructuredGrid *grid);

// Keeps only these cells, in ascending order, and their nodes (mesh_parts.cpp).
void keep_cells(riis_vtk_mesh &mesh, const std::vector<vtkIdType> &cells);

// Writes the arrays of cells as fields of a case of OpenFOAM, into the folder of a time (foam_fields.cpp).
void write_foam_fields(const std::string &path, const riis_vtk_mesh &mesh);

}  // namespace riis::vtk
