// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/read/grid_files.hpp"

#include <algorithm>
#include <array>

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkFieldData.h>
#include <vtkGenericCell.h>
#include <vtkIdTypeArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkVersionMacros.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "common/array_view.hpp"
#include "riis_vtk/read/other_files.hpp"
#include "riis_vtk/read/watched_reader.hpp"

namespace riis::vtk {

void check_array_lengths(const std::string &path, vtkFieldData *data, const char *kind, vtkIdType n) {
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    const vtkAbstractArray *array = data->GetAbstractArray(i);
    if (array->GetNumberOfTuples() != n) {
      const char *name = const_cast<vtkAbstractArray *>(array)->GetName();
      fail_file(path, kind, " array ", name ? name : "without a name", " has ", array->GetNumberOfTuples(),
                " values for ", n);
    }
  }
}

namespace {

void check_data_set(const std::string &path, vtkPointSet *data) {
  if (data->GetNumberOfPoints() == 0) fail_file(path, "holds no points");
  check_array_lengths(path, data->GetPointData(), "point", data->GetNumberOfPoints());
  check_array_lengths(path, data->GetCellData(), "cell", data->GetNumberOfCells());
}

// Checks the offsets. This function must be called before any cell is read.
void check_offsets(const std::string &path, vtkCellArray *cells) {
  if (cells && cells->GetNumberOfCells() > 0 && !cells->IsValid()) fail_file(path, "has broken cell offsets");
}

void check_point_id(const std::string &path, vtkIdType cell_id, vtkIdType point_id, vtkIdType n_points) {
  if (point_id < 0 || point_id >= n_points) {
    fail_file(path, "cell ", cell_id, " names point ", point_id, " of ", n_points);
  }
}

// Checks the point ids of cells. In the message, the first of the given cells has the id `first_id`.
void check_point_ids(const std::string &path, vtkCellArray *cells, vtkIdType first_id, vtkIdType n_points) {
  check_offsets(path, cells);
  const vtkIdType n_cells = cells ? cells->GetNumberOfCells() : 0;
  for (vtkIdType cell_id = 0; cell_id < n_cells; ++cell_id) {
    vtkIdType n = 0;
    const vtkIdType *ids = nullptr;
    cells->GetCellAtId(cell_id, n, ids);
    for (vtkIdType i = 0; i < n; ++i) check_point_id(path, first_id + cell_id, ids[i], n_points);
  }
}

// Checks faces. In the message, the first of the given faces has the id `first_id`.
void check_faces(const std::string &path, vtkCellArray *faces, vtkIdType first_id, vtkIdType n_points) {
  check_point_ids(path, faces, first_id, n_points);
  for (vtkIdType i = 0; i < faces->GetNumberOfCells(); ++i) {
    if (faces->GetCellSize(i) < 3) {
      fail_file(path, "cell ", first_id + i, " is a face with ", faces->GetCellSize(i), " points");
    }
  }
}

// For each type of cell, returns the number of points. The number is 0 if cells of the type have different numbers of points, and
// -1 for an unknown type.
std::array<int, 256> points_of_cell_types() {
  std::array<int, 256> n_points{};
  for (int type = 0; type < 256; ++type) {
    const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
    const bool variable = type >= VTK_HIGHER_ORDER_EDGE || (cell && cell->RequiresExplicitFaceRepresentation());
    n_points[static_cast<std::size_t>(type)] = !cell ? -1 : variable ? 0 : static_cast<int>(cell->GetNumberOfPoints());
  }
  return n_points;
}

// Checks the number of points of each cell, because VTK does not check it.
void check_cell_sizes(const std::string &path, vtkUnstructuredGrid *grid) {
  static const std::array<int, 256> points_of_type = points_of_cell_types();
  for (vtkIdType cell_id = 0; cell_id < grid->GetNumberOfCells(); ++cell_id) {
    const int type = grid->GetCellType(cell_id);
    const int n_expected = points_of_type[static_cast<std::size_t>(type)];
    const vtkIdType n = grid->GetCells()->GetCellSize(cell_id);
    if (n_expected < 0) fail_file(path, "cell ", cell_id, " has the unknown type ", type);
    if (n_expected > 0 && n != n_expected) {
      fail_file(path, "cell ", cell_id, " is a ", vtkCellTypes::GetClassNameFromTypeId(type), " with ", n, " points");
    }
  }
}

// Checks the faces of a polyhedron. In VTK's array of faces, the part of a cell begins with the number of faces. After this
// number, each face follows with its size and its points.
void check_polyhedron(const std::string &path, vtkIdType cell_id, vtkIdType location, vtkIdTypeArray *faces,
                      vtkIdType n_points) {
  const vtkIdType n_values = faces->GetNumberOfValues();
  const auto value = [&](vtkIdType i) {
    if (i < 0 || i >= n_values) fail_faces(path, cell_id);
    return faces->GetValue(i);
  };
  vtkIdType position = location;
  const vtkIdType n_faces = value(position++);
  for (vtkIdType face = 0; face < n_faces; ++face) {
    const vtkIdType n_corners = value(position++);
    for (vtkIdType corner = 0; corner < n_corners; ++corner) check_point_id(path, cell_id, value(position++), n_points);
  }
}

void check_polyhedra(const std::string &path, vtkUnstructuredGrid *grid) {
  for (vtkIdType cell_id = 0; cell_id < grid->GetNumberOfCells(); ++cell_id) {
    if (grid->GetCellType(cell_id) != VTK_POLYHEDRON) continue;
    vtkIdTypeArray *faces = grid->GetFaces();
    vtkIdTypeArray *locations = grid->GetFaceLocations();
    if (!faces || !locations || locations->GetNumberOfValues() <= cell_id) {
      fail_file(path, "cell ", cell_id, " is a polyhedron without faces");
    }
    check_polyhedron(path, cell_id, locations->GetValue(cell_id), faces, grid->GetNumberOfPoints());
  }
}

// A reader that also reads the faces of polyhedra in the layout of VTK 9.4 and later. Older releases of VTK ignore the new
// layout. In the new layout, each polyhedron refers to faces in a common list, and each face refers to its corners.
class GridReader : public WatchedReader<vtkXMLUnstructuredGridReader> {
 public:
  static GridReader *New() { VTK_STANDARD_NEW_BODY(GridReader); }

 protected:
  int ReadPieceData() override {
    return vtkXMLUnstructuredGridReader::ReadPieceData() && steps().run([&] { read_new_faces(); });
  }

 private:
  using Ids = std::vector<vtkIdType>;

  void read_new_faces() {
    vtkXMLDataElement *cells = CellElements[Piece];
    const vtkIdType n_cells = NumberOfCells[Piece];
    auto *grid = vtkUnstructuredGrid::SafeDownCast(GetCurrentOutput());
    if (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0) || n_cells == 0) return;
    if (!FindDataArrayWithName(cells, "polyhedron_offsets") || FindDataArrayWithName(cells, "faces")) return;
    const Ids ends = offsets_in(cells, "polyhedron_offsets", n_cells);
    const Ids faces = ids_in(cells, "polyhedron_to_faces", ends.back());
    const vtkIdType n_faces = faces.empty() ? 0 : 1 + *std::max_element(faces.begin(), faces.end());
    const Ids corner_ends = offsets_in(cells, "face_offsets", n_faces);
    const Ids corners = ids_in(cells, "face_connectivity", n_faces == 0 ? 0 : corner_ends.back());
    // The first piece with polyhedra creates the list of faces. For later pieces, VTK enters -1 for the cells without faces.
    if (!grid->GetFaces()) {
      grid->InitializeFacesRepresentation(StartCell);
      for (vtkIdType i = 0; i < n_cells; ++i) grid->GetFaceLocations()->InsertNextValue(-1);
    }
    const auto begin_of = [](const Ids &all_ends, vtkIdType i) { return i == 0 ? 0 : view(all_ends)[i - 1]; };
    for (vtkIdType cell = 0; cell < n_cells; ++cell) {
      const vtkIdType begin = begin_of(ends, cell), end = view(ends)[cell];
      if (begin == end) continue;
      vtkIdTypeArray *stream = grid->GetFaces();
      grid->GetFaceLocations()->SetValue(StartCell + cell, stream->GetNumberOfValues());
      stream->InsertNextValue(end - begin);
      for (vtkIdType i = begin; i < end; ++i) {
        const vtkIdType face = view(faces)[i];
        if (face < 0) fail_faces(path(), StartCell + cell);
        const vtkIdType first = begin_of(corner_ends, face), last = view(corner_ends)[face];
        stream->InsertNextValue(last - first);
        for (vtkIdType k = first; k < last; ++k) {
          check_point_id(path(), StartCell + cell, view(corners)[k], NumberOfPoints[Piece]);
          stream->InsertNextValue(StartPoint + view(corners)[k]);
        }
      }
    }
  }

  // Reads n values of a cell array. Fails if the file holds fewer values.
  Ids ids_in(vtkXMLDataElement *cells, const char *name, vtkIdType n) {
    vtkXMLDataElement *element = FindDataArrayWithName(cells, name);
    const auto created = vtkSmartPointer<vtkAbstractArray>::Take(element ? CreateArray(element) : nullptr);
    vtkDataArray *array = vtkDataArray::SafeDownCast(created);
    if (!array || array->GetNumberOfComponents() != 1) fail_file(path(), "has polyhedra without ", name);
    check_held(element, n, array);
    array->SetNumberOfTuples(n);
    if (n > 0 && !ReadArrayValues(element, 0, array, 0, n)) {
      steps().rethrow();
      fail_file(path(), "is damaged: array ", name, " cannot be read");
    }
    Ids ids(static_cast<std::size_t>(n));
    for (vtkIdType i = 0; i < n; ++i) view(ids)[i] = id_at(array, i);
    return ids;
  }

  Ids offsets_in(vtkXMLDataElement *cells, const char *name, vtkIdType n) {
    Ids ends = ids_in(cells, name, n);
    if (!std::is_sorted(ends.begin(), ends.end()) || (n > 0 && ends.front() < 0))
      fail_file(path(), "has broken ", name);
    return ends;
  }
};

vtkSmartPointer<vtkUnstructuredGrid> read_legacy_grid(const std::string &path, const LegacyContent &content,
                                                      const CaughtOutput &caught) {
  return read_scanned<vtkUnstructuredGridReader, vtkUnstructuredGrid>(path, content, caught);
}

// Checks polydata after it was read, and prepares its cells.
void finish_polydata(const std::string &path, vtkPolyData *data) {
  check_data_set(path, data);
  if (data->GetNumberOfVerts() > 0 || data->GetNumberOfLines() > 0) {
    fail_file(path, "holds ", data->GetNumberOfVerts(), " vertices and ", data->GetNumberOfLines(),
              " lines; a surface has faces only");
  }
  check_faces(path, data->GetPolys(), 0, data->GetNumberOfPoints());
  check_faces(path, data->GetStrips(), data->GetNumberOfPolys(), data->GetNumberOfPoints());
  // During this call, VTK determines the types of the cells.
  data->BuildCells();
}

}  // namespace

void check_lattice(const std::string &path, const Lattice &lattice) {
  constexpr std::int64_t most_points = std::int64_t{1} << 40;
  std::int64_t n_left = most_points;
  for (const std::int64_t n : lattice.n) {
    if (n < 1) fail_file(path, "holds no points");
    if (n > n_left)
      fail_file(path, "claims ", lattice.n[0], " times ", lattice.n[1], " times ", lattice.n[2],
                " points, more than the ", most_points, " of a mesh");
    n_left /= n;
  }
}

void check_grid(const std::string &path, vtkUnstructuredGrid *grid) {
  check_data_set(path, grid);
  check_point_ids(path, grid->GetCells(), 0, grid->GetNumberOfPoints());
  check_cell_sizes(path, grid);
  check_polyhedra(path, grid);
}

vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string &path, const CaughtOutput &caught, Points points) {
  const std::string ending = ending_of(path);
  vtkSmartPointer<vtkUnstructuredGrid> grid;
  if (is_openfoam(path)) {
    grid = read_openfoam(path);
  } else if (ending == "vtu") {
    check_xml(path, "UnstructuredGrid");
    grid = read_xml<GridReader, vtkUnstructuredGrid>(path, caught);
  } else if (ending == "vtk") {
    grid = read_legacy_grid(path, check_legacy(path, LegacyKinds::grid), caught);
  } else if (ending == "msh") {
    grid = read_gmsh(path);
  } else if (ending == "xdmf" || ending == "xmf") {
    grid = read_xdmf(path);
  } else if (ending == "e" || ending == "exo" || ending == "ex2" || ending == "exii") {
    grid = read_exodus(path, caught);
  } else if (ending == "vtm") {
    grid = read_blocks(path, caught);
  } else if (is_foam_time(path)) {
    fail_file(path, "there is no such time of the case; written are ", foam_times_of(foam_case_of(path)));
  } else {
    fail_file(path,
              "a mesh must be a .vtu, .vtk, .vti, .vtr, .vts, .vtm, .msh, .xdmf or .exo file, or a case of OpenFOAM");
  }
  if (points == Points::may_be_missing && grid->GetNumberOfPoints() == 0 && grid->GetNumberOfCells() == 0) return grid;
  check_grid(path, grid);
  return grid;
}

vtkSmartPointer<vtkPolyData> read_polydata(const std::string &path, const CaughtOutput &caught) {
  check_xml(path, "PolyData");
  vtkSmartPointer<vtkPolyData> data = read_xml<WatchedReader<vtkXMLPolyDataReader>, vtkPolyData>(path, caught);
  finish_polydata(path, data);
  return data;
}

vtkSmartPointer<vtkPointSet> read_legacy_surface(const std::string &path, const CaughtOutput &caught) {
  const LegacyContent content = check_legacy(path, LegacyKinds::grid_or_polydata);
  if (content.kind == LegacyKind::unstructured_grid) {
    const auto grid = read_legacy_grid(path, content, caught);
    check_grid(path, grid);
    return grid;
  }
  const auto data = read_scanned<vtkPolyDataReader, vtkPolyData>(path, content, caught);
  finish_polydata(path, data);
  return data;
}

}  // namespace riis::vtk
