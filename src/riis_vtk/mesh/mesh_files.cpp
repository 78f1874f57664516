// SPDX-License-Identifier: Apache-2.0
// The functions of riis_vtk.h for volume meshes. Reads a file into a grid with points in double precision, and makes an adjacency
// from the grid's cells. Stores marks in the grid's point arrays, and writes the grid to a .vtu file.
#include <riis/riis_vtk.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "common/array_view.hpp"
#include "common/elementary.hpp"
#include "riis_vtk/mesh/mesh.hpp"
#include "riis_vtk/read/grid_files.hpp"
#include "riis_vtk/read/other_files.hpp"
#include "riis_vtk/read/structured_files.hpp"

namespace riis::vtk {

// Removes the reader's note from the grid and returns it. For a file in a format of VTK, the note may say that the points have
// single precision.
std::string take_note(vtkUnstructuredGrid *grid) {
  std::string note;
  if (auto *const array = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray(note_array))) {
    if (array->GetNumberOfValues() > 0) note = array->GetValue(0);
    grid->GetFieldData()->RemoveArray(note_array);
  }
  const bool is_single = grid->GetPoints() && grid->GetPoints()->GetDataType() == VTK_FLOAT;
  return note.empty() && is_single ? "its points have single precision" : note;
}

// Removes the names of physical groups from the grid and returns them.
std::vector<RegionName> take_region_names(vtkUnstructuredGrid *grid) {
  std::vector<RegionName> names;
  if (auto *const array = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray(region_names_array))) {
    for (vtkIdType i = 0; i + 1 < array->GetNumberOfValues(); i += 2) {
      names.push_back({0, array->GetValue(i + 1)});
      read_number(std::string_view(array->GetValue(i)), names.back().number);
    }
    grid->GetFieldData()->RemoveArray(region_names_array);
  }
  return names;
}

void make_points_double(vtkUnstructuredGrid *grid) {
  if (grid->GetPoints() && vtkDoubleArray::SafeDownCast(grid->GetPoints()->GetData())) return;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  if (grid->GetPoints()) points->DeepCopy(grid->GetPoints());
  grid->SetPoints(points);
}

namespace {

// Throws an exception with the core's error. The name of the struct is removed from the message, because the caller passed a
// plain argument.
void check_adjacency(riis_status status, const std::string &structure) {
  if (status == RIIS_OK) return;
  const std::string text = riis_last_error();
  fail(status, text.rfind(structure, 0) == 0 ? text.substr(structure.size()) : text);
}

// Makes an adjacency of nodes from edges. The core has a function that makes the adjacency of cells from the faces between cells.
// Here this function gets the nodes as if they were cells, and the edges as if they were faces.
riis_adjacency *adjacency_of_edges(std::int64_t n_nodes, const std::vector<std::int64_t> &edges,
                                   std::int32_t n_threads) {
  riis_mesh_faces faces;
  check_core(riis_mesh_faces_init(&faces, sizeof faces));
  faces.n_cells = n_nodes;
  faces.n_faces = static_cast<std::int64_t>(edges.size() / 2);
  if (!edges.empty()) {
    faces.owner = edges.data();
    faces.neighbor = edges.data() + 1;
  }
  faces.stride = 2;
  faces.id_bits = 64;
  faces.n_threads = n_threads;
  riis_adjacency *made = nullptr;
  check_adjacency(riis_adjacency_create_from_faces(&faces, &made), "faces.");
  return made;
}

riis_adjacency *adjacency_of(vtkUnstructuredGrid *grid, std::int32_t n_threads) {
  const VolumeCounts counts = count_volumes(grid);
  if (counts.n_linear == 0 || counts.n_linear < counts.n_volumes)
    return adjacency_of_edges(grid->GetNumberOfPoints(), volume_edges_of(grid).node_ids, n_threads);
  // If all volume cells are linear, passes the list of cells, which is a third as long as the list of edges.
  const VolumeCells volumes = volume_cells_of(grid);
  riis_mesh_cells cells;
  check_core(riis_mesh_cells_init(&cells, sizeof cells));
  cells.n_nodes = grid->GetNumberOfPoints();
  cells.n_cells = view(volumes.offsets).size() - 1;
  cells.node_ids = volumes.node_ids.data();
  cells.offsets = volumes.offsets.data();
  cells.id_bits = 64;
  cells.n_threads = n_threads;
  riis_adjacency *made = nullptr;
  check_adjacency(riis_adjacency_create_from_cells(&cells, &made), "cells.");
  return made;
}

void check_length(double longer_than) {
  if (longer_than >= 0 && std::isfinite(longer_than)) return;
  refuse_argument("longer_than is ", longer_than, "; it must be finite and at least 0");
}

const double *points_of(const riis_vtk_mesh *mesh) {
  if (mesh->centers) return mesh->centers->xyz.data();
  mesh->make_points();
  return vtkDoubleArray::SafeDownCast(mesh->data->GetPoints()->GetData())->GetPointer(0);
}

// Returns the pairs of neighbouring cells as edges. The two ends of an edge are the centres of two neighbouring cells.
std::vector<std::int64_t> long_pairs_of(const CellCenters &centers, const LongEdges &wanted) {
  std::vector<std::int64_t> pairs;
  for (std::int64_t i = 0; i < view(centers.pairs).size(); i += 2) {
    const std::int64_t a = view(centers.pairs)[i], b = view(centers.pairs)[i + 1];
    if (wanted.has(centers.xyz.data() + 3 * a, centers.xyz.data() + 3 * b)) pairs.insert(pairs.end(), {a, b});
  }
  return pairs;
}

double median_edge_of(const CellCenters &centers) {
  const std::int64_t n = view(centers.pairs).size() / 2, step = std::max<std::int64_t>(1, n / most_measured);
  std::vector<double> lengths;
  for (std::int64_t i = 0; i < n; i += step) {
    const double *const a = centers.xyz.data() + 3 * view(centers.pairs)[2 * i];
    const double *const b = centers.xyz.data() + 3 * view(centers.pairs)[2 * i + 1];
    lengths.push_back(hypotenuse(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
  }
  return median_of(std::move(lengths));
}

// The functions below add point arrays to a grid. riis_vtk.h documents their names. The values come from a marking or from the
// caller.

void check_are_of_mesh(const riis_marks *marks, vtkIdType n_nodes) {
  riis_mark_stats stats{};
  check_core(riis_marks_get_stats(marks, &stats, sizeof stats));
  if (stats.n_nodes != n_nodes) {
    refuse_argument("marks are of a mesh with ", stats.n_nodes, " nodes, this mesh has ", n_nodes);
  }
}

// Refuses a name that some file formats or readers cannot handle.
void check_name(const char *argument, const std::string &name) {
  constexpr std::size_t longest = 64;
  const auto is_good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  if (name.empty() || name.size() > longest || !std::all_of(name.begin(), name.end(), is_good)) {
    refuse_argument(argument, " is \"", name.substr(0, longest), "\"; it must be 1 to ", longest,
                    " letters, digits, _, - and .");
  }
}

// The nodes that are within the distance limit of a marking.
struct Within {
  std::int64_t n = 0;
  const std::int64_t *node_id = nullptr;
};

// Adds an array. At the nodes within the limit, it has the given values. At all other nodes, the value is `elsewhere`.
template <class Array, class Value>
void add_field(riis_vtk_mesh *mesh, const std::string &name, const Within &within, int n_components,
               const Value *values, Value elsewhere) {
  if (!values && within.n > 0) refuse_argument("marks lack the field of ", name);
  const auto array = named_array<Array>(name, mesh->n_nodes(), n_components);
  Value *const to = array->GetPointer(0);
  std::fill_n(to, n_components * mesh->n_nodes(), elsewhere);
  for (std::int64_t i = 0; i < within.n; ++i)
    std::copy_n(values + n_components * i, n_components, to + n_components * within.node_id[i]);
  mesh->node_data()->AddArray(array);
}

void check_fields(std::int32_t fields) {
  constexpr std::int32_t all = 2 * RIIS_FIELD_PATCH - 1;
  if (fields >= 0 && fields <= all) return;
  refuse_argument("fields is ", fields, "; it must be a sum of RIIS_FIELD_*");
}

// Sets the arrays PREFIX_marked, PREFIX_distance and PREFIX_leaflet.
void set_marks(riis_vtk_mesh *mesh, const riis_marks *marks, double far_distance, const std::string &prefix) {
  check_name("prefix", prefix);
  const vtkIdType n = mesh->n_nodes();
  check_are_of_mesh(marks, n);
  const auto marked = named_array<vtkUnsignedCharArray>(prefix + "_marked", n);
  const auto distance = named_array<vtkDoubleArray>(prefix + "_distance", n);
  const auto leaflet = named_array<vtkTypeInt32Array>(prefix + "_leaflet", n);
  riis_dense_arrays to;
  check_core(riis_dense_arrays_init(&to, sizeof to));
  to.n_nodes = n;
  to.far_distance = far_distance;
  to.mark = marked->GetPointer(0);
  to.distance = distance->GetPointer(0);
  to.leaflet_id = leaflet->GetPointer(0);
  check_core(riis_marks_get_dense(marks, &to));
  for (vtkDataArray *array : {static_cast<vtkDataArray *>(marked), static_cast<vtkDataArray *>(distance),
                              static_cast<vtkDataArray *>(leaflet)}) {
    mesh->node_data()->AddArray(array);
  }
}

// Sets a point array. The shape of `values` is (n_components, n_nodes).
void set_point_array(riis_vtk_mesh *mesh, const std::string &name, std::int64_t n_nodes, std::int64_t n_components,
                     const double *values) {
  check_name("name", name);
  const vtkIdType n = mesh->n_nodes();
  if (n_nodes != n) refuse_argument("n_nodes is ", n_nodes, "; the mesh has ", n, " nodes");
  if (n_components < 1 || n_components > 9)
    refuse_argument("n_components is ", n_components, "; it must be from 1 to 9");
  const auto array = named_array<vtkDoubleArray>(name, n, static_cast<int>(n_components));
  std::copy_n(values, n * n_components, array->GetPointer(0));
  mesh->node_data()->AddArray(array);
}

// Stores the unit of a point array under a key of the array. VTK's writers also write the keys of an array.
void set_unit(riis_vtk_mesh *mesh, const std::string &name, const std::string &unit) {
  constexpr std::size_t longest = 64;
  const auto is_printed = [](char c) { return c >= ' ' && c <= '~'; };
  if (unit.empty() || unit.size() > longest || !std::all_of(unit.begin(), unit.end(), is_printed))
    refuse_argument("unit is \"", unit.substr(0, longest), "\"; it must be 1 to ", longest, " printed characters");
  vtkAbstractArray *const array = mesh->node_data()->GetAbstractArray(name.c_str());
  if (!array) refuse_argument("name is \"", name.substr(0, longest), "\", which is not a point array of the mesh");
  array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit.c_str());
}

// Sets an array for each of the given fields, with a name such as PREFIX_normal.
void set_fields(riis_vtk_mesh *mesh, const riis_marks *marks, std::int32_t fields, const std::string &prefix) {
  check_name("prefix", prefix);
  check_fields(fields);
  check_are_of_mesh(marks, mesh->n_nodes());
  riis_mark_list of{};
  check_core(riis_marks_get_list(marks, RIIS_LIST_WITHIN_LIMIT, &of, sizeof of));
  const Within within{of.n_nodes, of.node_id};
  const auto add_doubles = [&](std::int32_t field, const char *name, int n_components, const double *values) {
    if (fields & field) add_field<vtkDoubleArray>(mesh, prefix + name, within, n_components, values, 0.0);
  };
  const auto add_integers = [&](std::int32_t field, const char *name, const std::int32_t *values,
                                std::int32_t elsewhere) {
    if (fields & field) add_field<vtkTypeInt32Array>(mesh, prefix + name, within, 1, values, elsewhere);
  };
  add_doubles(RIIS_FIELD_POINT, "_point", 3, of.point);
  add_doubles(RIIS_FIELD_NORMAL, "_normal", 3, of.normal);
  add_doubles(RIIS_FIELD_BARYCENTRIC, "_barycentric", 3, of.barycentric);
  add_integers(RIIS_FIELD_SIDE, "_side", of.side, 0);
  add_integers(RIIS_FIELD_RIM, "_rim", of.rim, 0);
  add_doubles(RIIS_FIELD_UV, "_uv", 2, of.uv);
  add_doubles(RIIS_FIELD_VELOCITY, "_velocity", 3, of.velocity);
  add_integers(RIIS_FIELD_PATCH, "_patch", of.patch_id, -1);
}

}  // namespace
}  // namespace riis::vtk

using namespace riis::vtk;

vtkDataSetAttributes *riis_vtk_mesh::node_data() const {
  return centers ? static_cast<vtkDataSetAttributes *>(data->GetCellData()) : data->GetPointData();
}

extern "C" {

RIIS_API riis_status riis_vtk_mesh_read(const char *path, riis_vtk_mesh **mesh) {
  return guarded([&](const CaughtOutput &caught) {
    require(path, "path");
    require(mesh, "mesh");
    naming(path, [&] {
      auto made = std::make_unique<riis_vtk_mesh>();
      if (is_structured(path)) {
        StructuredFile file = read_structured(path, caught);
        made->data = file.data;
        made->axes = std::move(file.axes);
      } else {
        made->data = read_grid(path, caught);
      }
      made->notes = take_note(made->data);
      made->region_names = take_region_names(made->data);
      if (is_openfoam(path)) {
        made->foam_case = foam_case_of(path);
        if (is_foam_time(path)) made->foam_time = path;
      }
      if (!made->axes) make_points_double(made->data);
      *mesh = made.release();
    });
  });
}

RIIS_API riis_status riis_vtk_mesh_get_notes(const riis_vtk_mesh *mesh, const char **notes) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    *require(notes, "notes") = mesh->notes.c_str();
  });
}

RIIS_API riis_status riis_vtk_mesh_use_centers(riis_vtk_mesh *mesh) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    if (!mesh->centers) mesh->centers = std::make_unique<const CellCenters>(centers_of(mesh->grid()));
  });
}

RIIS_API void riis_vtk_mesh_destroy(riis_vtk_mesh **mesh) { destroy(mesh); }

RIIS_API riis_status riis_vtk_mesh_get_nodes(const riis_vtk_mesh *mesh, int64_t *n_nodes, int64_t *n_cells,
                                             const double **xyz) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    if (n_nodes) *n_nodes = mesh->n_nodes();
    if (n_cells) *n_cells = mesh->n_cells();
    if (xyz) *xyz = points_of(mesh);
  });
}

RIIS_API riis_status riis_vtk_mesh_get_axes(const riis_vtk_mesh *mesh, riis_grid *grid, int64_t struct_size) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    check_core(riis_grid_init(require(grid, "grid"), struct_size));
    grid->ni = grid->nj = grid->nk = 0;
    if (!mesh->is_of_axes()) return;
    std::tie(grid->ni, grid->nj, grid->nk) = std::tuple(mesh->axes->size(0), mesh->axes->size(1), mesh->axes->size(2));
    std::tie(grid->x, grid->y, grid->z) =
        std::tuple(mesh->axes->of[0].data(), mesh->axes->of[1].data(), mesh->axes->of[2].data());
  });
}

RIIS_API riis_status riis_vtk_mesh_create_adjacency(const riis_vtk_mesh *mesh, int32_t n_threads,
                                                    riis_adjacency **adjacency) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    require(adjacency, "adjacency");
    *adjacency = mesh->centers ? adjacency_of_edges(mesh->n_nodes(), mesh->centers->pairs, n_threads)
                 : mesh->axes  ? adjacency_of(*mesh->axes, n_threads)
                               : adjacency_of(mesh->grid(), n_threads);
  });
}

RIIS_API riis_status riis_vtk_mesh_create_long_edges(const riis_vtk_mesh *mesh, const riis_surface *surface,
                                                     double longer_than, int32_t n_threads, int64_t *n_cells_left_out,
                                                     riis_adjacency **adjacency) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    require(surface, "surface");
    check_length(longer_than);
    require(adjacency, "adjacency");
    riis_surface_info info;
    check_core(riis_surface_get_info(surface, &info, sizeof info));
    const LongEdges wanted(longer_than, info.lower, info.upper);
    VolumeEdges edges;
    if (mesh->centers)
      edges.node_ids = long_pairs_of(*mesh->centers, wanted);
    else
      edges = long_edges_of(mesh->grid(), points_of(mesh), wanted);
    *adjacency = adjacency_of_edges(mesh->n_nodes(), edges.node_ids, n_threads);
    if (n_cells_left_out) *n_cells_left_out = edges.n_cells_left_out;
  });
}

RIIS_API riis_status riis_vtk_mesh_get_volume_cells(const riis_vtk_mesh *mesh, int64_t *n_volume_cells,
                                                    int64_t *n_cells_left_out) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    const VolumeCounts counts =
        mesh->axes ? VolumeCounts{mesh->axes->n_cells(), mesh->axes->n_cells()} : count_volumes(mesh->grid());
    if (n_volume_cells) *n_volume_cells = counts.n_volumes;
    if (n_cells_left_out) *n_cells_left_out = counts.n_unknown;
  });
}

RIIS_API riis_status riis_vtk_mesh_set_marks(riis_vtk_mesh *mesh, const riis_marks *marks, double far_distance,
                                             const char *prefix) {
  return guarded([&](const CaughtOutput &) {
    set_marks(require(mesh, "mesh"), require(marks, "marks"), far_distance, prefix ? prefix : default_prefix);
  });
}

RIIS_API riis_status riis_vtk_mesh_set_fields(riis_vtk_mesh *mesh, const riis_marks *marks, int32_t fields,
                                              const char *prefix) {
  return guarded([&](const CaughtOutput &) {
    set_fields(require(mesh, "mesh"), require(marks, "marks"), fields, require(prefix, "prefix"));
  });
}

RIIS_API riis_status riis_vtk_mesh_set_point_array(riis_vtk_mesh *mesh, const char *name, int64_t n_nodes,
                                                   int64_t n_components, const double *values) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    set_point_array(mesh, require(name, "name"), n_nodes, n_components, require(values, "values"));
  });
}

RIIS_API riis_status riis_vtk_mesh_set_unit(riis_vtk_mesh *mesh, const char *name, const char *unit) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    set_unit(mesh, require(name, "name"), require(unit, "unit"));
  });
}

RIIS_API riis_status riis_vtk_mesh_has_point_array(const riis_vtk_mesh *mesh, const char *name, int32_t *has) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    require(name, "name");
    *require(has, "has") = mesh->node_data()->HasArray(name) != 0;
  });
}

RIIS_API riis_status riis_vtk_mesh_copy_cells(const riis_vtk_mesh *mesh, int64_t n_cells, int64_t *offsets,
                                              uint8_t *types, int64_t n_node_ids, int64_t *node_ids) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    if (mesh->centers) refuse_argument("the nodes of mesh are centres of cells, and no cells join them");
    vtkUnstructuredGrid *const grid = mesh->grid();
    const int64_t n_all = grid->GetNumberOfCells();
    if (n_cells != n_all) refuse_argument("n_cells is ", n_cells, "; the mesh has ", n_all, " cells");
    const int64_t n_ids = n_all > 0 ? grid->GetCells()->GetNumberOfConnectivityIds() : 0;
    if (node_ids && n_node_ids != n_ids)
      refuse_argument("n_node_ids is ", n_node_ids, "; the cells have ", n_ids, " node ids");
    int64_t n = 0;
    for (int64_t i = 0; i < n_cells; ++i) {
      if (offsets) offsets[i] = n;
      if (types) types[i] = static_cast<uint8_t>(grid->GetCellType(i));
      vtkIdType n_points = 0;
      const vtkIdType *points = nullptr;
      grid->GetCellPoints(i, n_points, points);
      if (node_ids) std::copy(points, points + n_points, node_ids + n);
      n += n_points;
    }
    if (offsets) offsets[n_cells] = n;
  });
}

RIIS_API riis_status riis_vtk_mesh_get_median_edge(const riis_vtk_mesh *mesh, double *length) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    require(length, "length");
    *length = mesh->centers ? median_edge_of(*mesh->centers)
              : mesh->axes  ? median_edge_of(*mesh->axes)
                            : median_edge_of(mesh->grid());
  });
}

RIIS_API riis_status riis_vtk_mesh_write(const riis_vtk_mesh *mesh, const char *path) {
  return guarded([&](const CaughtOutput &caught) {
    require(mesh, "mesh");
    require(path, "path");
    naming(path, [&] {
      if (is_foam_time(path) && !mesh->whole_cell_ids.empty())
        refuse_argument("mesh has only a part of the cells, but fields of OpenFOAM need all cells");
      if (is_foam_time(path))
        write_foam_fields(path, *mesh);
      else if (ending_of(path) == "xdmf")
        write_xdmf(path, mesh->grid());
      else if (ending_of(path) == "vti" || ending_of(path) == "vtr")
        write_axes(path, *mesh, caught);
      else
        write_xml<vtkXMLUnstructuredGridWriter>(path, "vtu", mesh->grid(), caught);
    });
  });
}

}  // extern "C"
