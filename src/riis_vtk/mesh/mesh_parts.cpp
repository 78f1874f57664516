// SPDX-License-Identifier: Apache-2.0
// The functions of riis_vtk.h for parts of volume meshes. A part is itself a mesh. It consists of the cells around certain nodes
// of the whole mesh.
#include <algorithm>
#include <memory>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>

#include "common/array_view.hpp"
#include "riis_vtk/base/files.hpp"
#include "riis_vtk/mesh/mesh.hpp"

namespace riis::vtk {
namespace {

using Chosen = std::vector<std::uint8_t>;

Chosen chosen_nodes(vtkUnstructuredGrid *grid, std::int64_t n_ids, const std::int64_t *node_ids) {
  const vtkIdType n_nodes = grid->GetNumberOfPoints();
  if (n_ids < 0) refuse_argument("n_ids is ", n_ids);
  if (n_ids > 0) require(node_ids, "node_ids");
  Chosen chosen(static_cast<std::size_t>(n_nodes));
  for (std::int64_t i = 0; i < n_ids; ++i) {
    if (node_ids[i] < 0 || node_ids[i] >= n_nodes) {
      refuse_argument("node_ids[", i, "] is ", node_ids[i], "; the mesh has ", n_nodes, " nodes");
    }
    view(chosen)[node_ids[i]] = 1;
  }
  return chosen;
}

// Returns the cells that have at least one chosen node. All nodes of the returned cells are added to the chosen nodes.
std::vector<vtkIdType> cells_around(vtkUnstructuredGrid *grid, Chosen &chosen) {
  const Chosen wanted = chosen;
  std::vector<vtkIdType> cells;
  vtkNew<vtkIdList> nodes;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    grid->GetCellPoints(cell, nodes);
    if (std::none_of(nodes->begin(), nodes->end(), [&](vtkIdType node) { return view(wanted)[node] != 0; })) continue;
    cells.push_back(cell);
    for (const vtkIdType node : *nodes) view(chosen)[node] = 1;
  }
  return cells;
}

std::vector<vtkIdType> ids_of(const Chosen &chosen) {
  std::vector<vtkIdType> ids;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (chosen[i]) ids.push_back(static_cast<vtkIdType>(i));
  return ids;
}

// Converts ids of a mesh to ids of the whole mesh. If the mesh is a part of the whole mesh, `whole` has the ids of its nodes in
// the whole mesh. Otherwise `whole` is empty.
std::vector<std::int64_t> whole_ids(const std::vector<vtkIdType> &ids, const std::vector<std::int64_t> &whole) {
  std::vector<std::int64_t> made(ids.begin(), ids.end());
  if (!whole.empty())
    for (std::int64_t &id : made) id = view(whole)[id];
  return made;
}

// Copies the values at the given nodes or cells. Also adds an array with the nodes' or the cells' ids in the whole mesh.
void copy_data(vtkDataSetAttributes *from, const std::vector<vtkIdType> &ids, const char *id_array,
               const std::vector<std::int64_t> &whole, vtkDataSetAttributes *to) {
  const auto n = static_cast<vtkIdType>(ids.size());
  to->CopyAllOn();
  to->CopyAllocate(from, n);
  for (vtkIdType i = 0; i < n; ++i) to->CopyData(from, view(ids)[i], i);
  const auto array = named_array<vtkTypeInt64Array>(id_array, n);
  const std::vector<std::int64_t> in_whole = whole_ids(ids, whole);
  std::copy(in_whole.begin(), in_whole.end(), array->GetPointer(0));
  to->AddArray(array);
}

// Adds a cell whose corners get new numbers. The stream of a polyhedron's faces begins with the number of faces. After this
// number, each face follows with its size and its nodes.
void add_cell(vtkUnstructuredGrid *grid, vtkIdType cell, const std::vector<vtkIdType> &new_id, vtkIdList *nodes,
              vtkUnstructuredGrid *part) {
  const int type = grid->GetCellType(cell);
  if (type == VTK_POLYHEDRON) {
    grid->GetFaceStream(cell, nodes);
    vtkIdType at = 1;
    for (vtkIdType face = 0; face < nodes->GetId(0); ++face) {
      const vtkIdType end = at + 1 + nodes->GetId(at);
      for (++at; at < end; ++at) nodes->SetId(at, view(new_id)[nodes->GetId(at)]);
    }
  } else {
    grid->GetCellPoints(cell, nodes);
    for (vtkIdType i = 0; i < nodes->GetNumberOfIds(); ++i) nodes->SetId(i, view(new_id)[nodes->GetId(i)]);
  }
  part->InsertNextCell(type, nodes);
}

// Makes a grid from the given cells and the chosen nodes. All nodes of the given cells must be chosen.
vtkSmartPointer<vtkUnstructuredGrid> part_of(const riis_vtk_mesh &mesh, const std::vector<vtkIdType> &cells,
                                             const Chosen &chosen) {
  vtkUnstructuredGrid *const grid = mesh.grid();
  const std::vector<vtkIdType> nodes = ids_of(chosen);
  std::vector<vtkIdType> new_id(chosen.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(nodes.size()));
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
    double point[3];
    grid->GetPoint(view(nodes)[i], point);
    points->SetPoint(i, point);
    view(new_id)[view(nodes)[i]] = i;
  }
  const auto part = vtkSmartPointer<vtkUnstructuredGrid>::New();
  part->SetPoints(points);
  part->AllocateEstimate(static_cast<vtkIdType>(cells.size()), 8);
  vtkNew<vtkIdList> corners;
  for (const vtkIdType cell : cells) add_cell(grid, cell, new_id, corners, part);
  copy_data(grid->GetPointData(), nodes, node_id_array, mesh.whole_node_ids, part->GetPointData());
  copy_data(grid->GetCellData(), cells, cell_id_array, mesh.whole_cell_ids, part->GetCellData());
  part->GetFieldData()->PassData(grid->GetFieldData());
  return part;
}

std::int64_t bytes_of(vtkAbstractArray *array) {
  auto *const strings = vtkStringArray::SafeDownCast(array);
  if (!strings) return array->GetNumberOfValues() * array->GetDataTypeSize();
  std::int64_t n = 0;
  for (vtkIdType i = 0; i < strings->GetNumberOfValues(); ++i)
    n += static_cast<std::int64_t>(strings->GetValue(i).size()) + 1;
  return n;
}

std::int64_t bytes_of(vtkFieldData *data) {
  std::int64_t n = 0;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) n += bytes_of(data->GetAbstractArray(i));
  return n;
}

std::int64_t file_size_of(vtkUnstructuredGrid *grid) {
  constexpr std::int64_t id_bytes = 8, point_bytes = 3 * 8, type_bytes = 1;
  const std::int64_t n_cells = grid->GetNumberOfCells();
  std::int64_t n = grid->GetNumberOfPoints() * point_bytes + n_cells * (id_bytes + type_bytes);
  if (n_cells > 0) n += grid->GetCells()->GetNumberOfConnectivityIds() * id_bytes;
  if (vtkIdTypeArray *faces = grid->GetFaces()) n += (faces->GetNumberOfValues() + n_cells) * id_bytes;
  return n + bytes_of(grid->GetPointData()) + bytes_of(grid->GetCellData()) + bytes_of(grid->GetFieldData());
}

}  // namespace

void keep_cells(riis_vtk_mesh &mesh, const std::vector<vtkIdType> &cells) {
  vtkUnstructuredGrid *const grid = mesh.grid();
  Chosen chosen(static_cast<std::size_t>(grid->GetNumberOfPoints()));
  vtkNew<vtkIdList> nodes;
  for (const vtkIdType cell : cells) {
    grid->GetCellPoints(cell, nodes);
    for (const vtkIdType node : *nodes) view(chosen)[node] = 1;
  }
  const auto part = part_of(mesh, cells, chosen);
  mesh.whole_node_ids = whole_ids(ids_of(chosen), mesh.whole_node_ids);
  mesh.whole_cell_ids = whole_ids(cells, mesh.whole_cell_ids);
  mesh.data = part;
  mesh.axes.reset();
}

}  // namespace riis::vtk

using namespace riis::vtk;

extern "C" {

RIIS_API riis_status riis_vtk_mesh_extract(const riis_vtk_mesh *mesh, int64_t n_ids, const int64_t *node_ids,
                                           riis_vtk_mesh **part) {
  return guarded([&](const CaughtOutput &) {
    vtkUnstructuredGrid *grid = require(mesh, "mesh")->grid();
    if (mesh->centers) refuse_argument("no part of mesh can be made, because its nodes are the centres of cells");
    require(part, "part");
    auto made = std::make_unique<riis_vtk_mesh>();
    Chosen chosen = chosen_nodes(grid, n_ids, node_ids);
    const std::vector<vtkIdType> cells = cells_around(grid, chosen);
    made->data = part_of(*mesh, cells, chosen);
    *part = made.release();
  });
}

RIIS_API riis_status riis_vtk_mesh_get_file_size(const riis_vtk_mesh *mesh, int64_t *n_bytes) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    *require(n_bytes, "n_bytes") = file_size_of(mesh->grid());
  });
}

}  // extern "C"
