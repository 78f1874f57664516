// SPDX-License-Identifier: Apache-2.0
// The mesh handle, which contains a grid, and functions on grids.
// The input is a grid whose cells have been checked. The results are the edges of the mesh's cells, the typical length of these
// edges, and the linear volume cells. The volume cells are plain arrays for riis_adjacency_create_from_cells.
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

// A value of a cell array that has a name, such as a physical group of gmsh.
struct RegionName {
  double number;
  std::string name;
};

// The cell array whose values number the domains of a mesh, and these values. A mesh may have no such array.
struct Regions {
  std::string array = {};
  std::vector<double> values = {};
};

}  // namespace riis::vtk

struct riis_vtk_mesh {
  // A mesh. The points of its grid are a vtkDoubleArray. If axes give the nodes of the mesh, the grid has only arrays at first.
  // grid() makes its points and cells.
  vtkSmartPointer<vtkUnstructuredGrid> data;
  std::unique_ptr<const riis::vtk::GridAxes> axes = {};
  std::string notes = {};      // the notes that riis_vtk_mesh_get_notes gives
  std::string foam_case = {};  // the folder of the case that the mesh was read from, or ""
  std::string foam_time = {};  // the folder of the time that the path of the mesh names, or ""
  // A mesh of cell centres has the centres as its nodes, so the data of its nodes is data of cells.
  std::unique_ptr<const riis::vtk::CellCenters> centers = {};
  std::vector<riis::vtk::RegionName> region_names = {};  // names of gmsh's physical groups of volumes
  riis::vtk::Regions regions = {};                       // as riis_vtk_mesh_find_regions found them
  // If only some cells were kept: the ids that the kept nodes and cells have in the whole mesh. The lists are empty if all cells
  // were kept.
  std::vector<std::int64_t> whole_node_ids = {}, whole_cell_ids = {};

  std::int64_t n_nodes() const { return centers ? n_cells() : axes ? axes->n_nodes() : data->GetNumberOfPoints(); }
  std::int64_t n_cells() const { return axes ? axes->n_cells() : data->GetNumberOfCells(); }
  // Returns whether axes give the nodes.
  bool is_of_axes() const { return axes && !centers; }
  vtkDataSetAttributes *node_data() const;
  void make_points() const;           // makes the points from the axes, unless they exist
  vtkUnstructuredGrid *grid() const;  // with points and cells
};

namespace riis::vtk {

// Does the same as median_edge_of, for a mesh given by axes.
double median_edge_of(const GridAxes &axes);
// Returns the adjacency of the nodes of a grid that is given by axes.
riis_adjacency *adjacency_of(const GridAxes &axes, std::int32_t n_threads);
// Sets is_outside to 0 for each point within the given distance of the axes' box.
void find_outside(const GridAxes &axes, std::int64_t n_points, const double *xyz, double distance,
                  std::uint8_t *is_outside);
// Writes the arrays to a .vtr file with axes. If the axes are those of an image, writes a .vti file instead.
void write_axes(const std::string &path, const riis_vtk_mesh &mesh, const CaughtOutput &caught);

// Converts the points of the grid to double precision. If the grid has no list of points, it gets an empty list.
void make_points_double(vtkUnstructuredGrid *grid);

// The properties that all cells of a VTK type have in common. A node is given by its position in the list of the cell's nodes.
// The lists of edges and faces are empty for a type whose cells can have different edges and faces.
using Edge = std::array<vtkIdType, 2>;
struct CellShape {
  struct Face {
    std::vector<vtkIdType> nodes;  // the corners come first, anticlockwise seen from outside
    int n_corners;
  };
  int dimension = 0;
  std::vector<Edge> edges;  // the edges of a face or a volume
  std::vector<Face> faces;  // the faces of a volume
};
const CellShape &shape_of(int type);

struct VolumeCounts {
  std::int64_t n_volumes = 0;
  std::int64_t n_linear = 0;   // the number of volume cells that volume_cells_of returns
  std::int64_t n_unknown = 0;  // the number of volume cells whose edges are not known
};
// `ghosts` has a value for each cell, and may be NULL. A cell that `ghosts` marks is a copy of another piece's cell, and does not
// count.
VolumeCounts count_volumes(vtkUnstructuredGrid *grid, vtkUnsignedCharArray *ghosts = nullptr);

struct VolumeCells {
  std::vector<std::int64_t> node_ids;
  std::vector<std::int64_t> offsets = {0};  // one entry more than there are cells
};

// Returns the tetrahedra, pyramids, wedges and hexahedra of the grid. Voxels become hexahedra. Other cells are left out.
VolumeCells volume_cells_of(vtkUnstructuredGrid *grid);

// The edges of volume cells as pairs of nodes. An edge of several cells appears once for each cell.
struct VolumeEdges {
  std::vector<std::int64_t> node_ids;  // (2, n)
  std::int64_t n_cells_left_out = 0;   // volume cells whose edges are not known
};
VolumeEdges volume_edges_of(vtkUnstructuredGrid *grid);

// Chooses edges. An edge is chosen if it is longer than a given length, and if its bounding box meets the box from lower to
// upper.
struct LongEdges {
  LongEdges(double longer_than, const double *box_lower, const double *box_upper)
      : least_square(longer_than * (1 - 1e-9) * (longer_than * (1 - 1e-9))), lower(box_lower), upper(box_upper) {}
  // Returns whether the edge from a to b is chosen. The length is checked before the overlap of the boxes, because few edges of a
  // fine mesh are long.
  bool has(const double *a, const double *b) const;

  double least_square;
  const double *lower, *upper;
};
// Returns the chosen edges of the grid. xyz(3, n) has the grid's points.
VolumeEdges long_edges_of(vtkUnstructuredGrid *grid, const double *xyz, const LongEdges &wanted);

// Returns the median of the lengths, or 0 if there are no lengths.
double median_of(std::vector<double> lengths);
inline constexpr std::int64_t most_measured =
    20'000;  // a median is taken over at most this many cells or pairs of cells, evenly spaced in the list

// Returns the median length of the edges of faces and volumes, or 0 if no edge is known. An edge of several cells counts once for
// each cell.
double median_edge_of(vtkUnstructuredGrid *grid);

// Keeps only the given cells, in ascending order, and the nodes of these cells (mesh_parts.cpp).
void keep_cells(riis_vtk_mesh &mesh, const std::vector<vtkIdType> &cells);

// Writes cell arrays as fields of an OpenFOAM case, into the folder of a time (foam_fields.cpp).
void write_foam_fields(const std::string &path, const riis_vtk_mesh &mesh);

}  // namespace riis::vtk
