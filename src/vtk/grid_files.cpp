// SPDX-License-Identifier: Apache-2.0
#include "vtk/grid_files.hpp"

#include <array>

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDataArraySelection.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkGenericCell.h>
#include <vtkIdTypeArray.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "vtk/files.hpp"
#include "vtk/legacy_scan.hpp"
#include "vtk/xml_scan.hpp"

namespace riis::vtk {
namespace {

void check_array_lengths(const std::string &path, vtkFieldData *data, const char *kind, vtkIdType n) {
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    const vtkAbstractArray *array = data->GetAbstractArray(i);
    if (array->GetNumberOfTuples() != n) {
      const char *name = const_cast<vtkAbstractArray *>(array)->GetName();
      fail_file(path, std::string(kind) + " array " + (name ? name : "without a name") + " has " +
                          std::to_string(array->GetNumberOfTuples()) + " values for " + std::to_string(n));
    }
  }
}

void check_data_set(const std::string &path, vtkPointSet *data) {
  if (data->GetNumberOfPoints() == 0) fail_file(path, "holds no points");
  check_array_lengths(path, data->GetPointData(), "point", data->GetNumberOfPoints());
  check_array_lengths(path, data->GetCellData(), "cell", data->GetNumberOfCells());
}

// The offsets must be sound before any cell is read.
void check_offsets(const std::string &path, vtkCellArray *cells) {
  if (cells && cells->GetNumberOfCells() > 0 && !cells->IsValid()) fail_file(path, "has broken cell offsets");
}

void check_point_id(const std::string &path, vtkIdType cell_id, vtkIdType point_id, vtkIdType n_points) {
  if (point_id < 0 || point_id >= n_points) {
    fail_file(path, "cell " + std::to_string(cell_id) + " names point " + std::to_string(point_id) + " of " +
                        std::to_string(n_points));
  }
}

// first_id is the id of the first cell, for the message.
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

// first_id is the id of the first face, for the message.
void check_faces(const std::string &path, vtkCellArray *faces, vtkIdType first_id, vtkIdType n_points) {
  check_point_ids(path, faces, first_id, n_points);
  for (vtkIdType i = 0; i < faces->GetNumberOfCells(); ++i) {
    if (faces->GetCellSize(i) < 3) {
      fail_file(path, "cell " + std::to_string(first_id + i) + " is a face with " +
                          std::to_string(faces->GetCellSize(i)) + " points");
    }
  }
}

// Returns the number of points of each type of cell: 0 if the type leaves it open, -1 if there is no such type.
std::array<int, 256> points_of_cell_types() {
  std::array<int, 256> n_points{};
  for (int type = 0; type < 256; ++type) {
    const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
    const bool variable = type >= VTK_HIGHER_ORDER_EDGE || (cell && cell->RequiresExplicitFaceRepresentation());
    n_points[static_cast<std::size_t>(type)] = !cell ? -1 : variable ? 0 : static_cast<int>(cell->GetNumberOfPoints());
  }
  return n_points;
}

// VTK's cells do not check the number of their points.
void check_cell_sizes(const std::string &path, vtkUnstructuredGrid *grid) {
  static const std::array<int, 256> points_of_type = points_of_cell_types();
  for (vtkIdType cell_id = 0; cell_id < grid->GetNumberOfCells(); ++cell_id) {
    const int type = grid->GetCellType(cell_id);
    const int n_expected = points_of_type[static_cast<std::size_t>(type)];
    const vtkIdType n = grid->GetCells()->GetCellSize(cell_id);
    if (n_expected < 0)
      fail_file(path, "cell " + std::to_string(cell_id) + " has the unknown type " + std::to_string(type));
    if (n_expected > 0 && n != n_expected) {
      fail_file(path, "cell " + std::to_string(cell_id) + " is a " + vtkCellTypes::GetClassNameFromTypeId(type) +
                          " with " + std::to_string(n) + " points");
    }
  }
}

// Checks a polyhedron's faces. The array has, from the cell's location on, the number of faces, then each face's size and points.
void check_polyhedron(const std::string &path, vtkIdType cell_id, vtkIdType location, vtkIdTypeArray *faces,
                      vtkIdType n_points) {
  const vtkIdType n_values = faces->GetNumberOfValues();
  const auto value = [&](vtkIdType i) {
    if (i < 0 || i >= n_values) fail_file(path, "cell " + std::to_string(cell_id) + " has broken polyhedron faces");
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
      fail_file(path, "cell " + std::to_string(cell_id) + " is a polyhedron without faces");
    }
    check_polyhedron(path, cell_id, locations->GetValue(cell_id), faces, grid->GetNumberOfPoints());
  }
}

void check_grid(const std::string &path, vtkUnstructuredGrid *grid) {
  check_data_set(path, grid);
  check_point_ids(path, grid->GetCells(), 0, grid->GetNumberOfPoints());
  check_cell_sizes(path, grid);
  check_polyhedra(path, grid);
}

// Makes public what VTK's XML readers know about their own failure.
template <class Reader>
class WatchedReader : public Reader {
 public:
  static WatchedReader *New() { VTK_STANDARD_NEW_BODY(WatchedReader); }
  bool has_failed() const {
    return this->DataError || this->InformationError || this->ErrorCode != vtkErrorCode::NoError;
  }
};

// VTK 9.1 crashes while it writes the message about an array that it cannot read. So the first reader runs with messages off. A
// second reader, which leaves the arrays out, then names the fault of the rest.
template <class Reader>
[[noreturn]] void explain_failure(const std::string &path, const CaughtOutput &caught) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->UpdateInformation();
  reader->GetPointDataArraySelection()->DisableAllArrays();
  reader->GetCellDataArraySelection()->DisableAllArrays();
  reader->Update();
  caught.check(path);
  fail_file(path, "is damaged: not all of its arrays can be read");
}

// Runs an XML reader and compares its data set with the sizes that the file promised.
template <class Reader, class DataSet>
vtkSmartPointer<DataSet> read_xml(const std::string &path, const CaughtOutput &caught) {
  vtkNew<WatchedReader<Reader>> reader;
  reader->SetFileName(path.c_str());
  vtkObject::SetGlobalWarningDisplay(0);
  reader->Update();
  vtkObject::SetGlobalWarningDisplay(1);
  vtkSmartPointer<DataSet> data = reader->GetOutput();
  if (reader->has_failed() || !data || data->GetNumberOfPoints() != reader->GetNumberOfPoints() ||
      data->GetNumberOfCells() != reader->GetNumberOfCells()) {
    explain_failure<Reader>(path, caught);
  }
  return data;
}

vtkSmartPointer<vtkUnstructuredGrid> read_legacy(const std::string &path, const CaughtOutput &caught) {
  const std::int64_t n_cells = check_legacy(path);
  vtkNew<vtkUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  // The reader's default is to keep only one array of each kind.
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllColorScalarsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
  reader->Update();
  caught.check(path);
  vtkSmartPointer<vtkUnstructuredGrid> grid = reader->GetOutput();
  if (!grid) fail_file(path, "could not be read");
  if (grid->GetNumberOfCells() != n_cells) {
    fail_file(path, "gives " + std::to_string(grid->GetNumberOfCells()) + " of the " + std::to_string(n_cells) +
                        " cells that it promises");
  }
  return grid;
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string &path, const CaughtOutput &caught) {
  const std::string ending = ending_of(path);
  vtkSmartPointer<vtkUnstructuredGrid> grid;
  if (ending == "vtu") {
    check_xml(path, "UnstructuredGrid");
    grid = read_xml<vtkXMLUnstructuredGridReader, vtkUnstructuredGrid>(path, caught);
  } else if (ending == "vtk") {
    grid = read_legacy(path, caught);
  } else {
    fail_file(path, "a mesh must be a .vtu or .vtk file");
  }
  check_grid(path, grid);
  return grid;
}

vtkSmartPointer<vtkPolyData> read_polydata(const std::string &path, const CaughtOutput &caught) {
  check_xml(path, "PolyData");
  vtkSmartPointer<vtkPolyData> data = read_xml<vtkXMLPolyDataReader, vtkPolyData>(path, caught);
  check_data_set(path, data);
  if (data->GetNumberOfVerts() > 0 || data->GetNumberOfLines() > 0) {
    fail_file(path, "holds " + std::to_string(data->GetNumberOfVerts()) + " vertices and " +
                        std::to_string(data->GetNumberOfLines()) + " lines; a surface has faces only");
  }
  check_faces(path, data->GetPolys(), 0, data->GetNumberOfPoints());
  check_faces(path, data->GetStrips(), data->GetNumberOfPolys(), data->GetNumberOfPoints());
  // VTK knows the types of the cells only after this call.
  data->BuildCells();
  return data;
}

}  // namespace riis::vtk
