// SPDX-License-Identifier: Apache-2.0
#include "formats_shim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkHexahedron.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPyramid.h>
#include <vtkQuad.h>
#include <vtkSmartPointer.h>
#include <vtkTetra.h>
#include <vtkTriangle.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkWedge.h>
#include <vtkXMLMultiBlockDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>

#ifdef RIIS_TEST_EXODUS
#include <vtkExodusIIWriter.h>
#endif

namespace {

using Grid = vtkSmartPointer<vtkUnstructuredGrid>;

Grid read_grid(const std::string &path) {
  if (path.size() > 4 && path.substr(path.size() - 4) == ".vtu") {
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetOutput();
  }
  vtkNew<vtkUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

// The bytes of a point, or of a cell's type and points.
std::string bytes_of(vtkUnstructuredGrid *grid, vtkIdType node, int how) {
  double point[3];
  grid->GetPoint(node, point);
  for (double &x : point) {
    // In a loop that it vectorises, gcc 12 omits the conversion to float and back. A volatile float prevents this.
    const volatile auto rounded = static_cast<float>(x);
    x = how == SHIM_FLOATS ? static_cast<double>(rounded) : x + 0.0;  // -0 is 0
  }
  return std::string(reinterpret_cast<const char *>(point), sizeof point);
}

std::string cell_of(vtkUnstructuredGrid *grid, vtkIdType cell, int how) {
  vtkNew<vtkIdList> nodes;
  grid->GetCellPoints(cell, nodes);
  std::vector<std::string> corners;
  for (const vtkIdType node : *nodes) corners.push_back(bytes_of(grid, node, how));
  // VTK gives the points of a polyhedron in no particular order.
  if (how == SHIM_SETS || grid->GetCellType(cell) == VTK_POLYHEDRON) std::sort(corners.begin(), corners.end());
  std::string all = std::to_string(grid->GetCellType(cell)) + ":";
  for (const std::string &corner : corners) all += corner;
  return all;
}

int64_t n_different(std::vector<std::string> a, std::vector<std::string> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  std::vector<std::string> only;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
  return static_cast<int64_t>(only.size());
}

// Interpolates between the corners of the linear cell of this shape.
bool linear_place(vtkUnstructuredGrid *grid, vtkIdType cell, int type, const double *at, double place[3]) {
  double weights[8];
  int n = 0;
  switch (type) {
    case VTK_QUADRATIC_EDGE:
      weights[0] = 1 - at[0], weights[1] = at[0], n = 2;
      break;
    case VTK_QUADRATIC_TRIANGLE:
      vtkTriangle::InterpolationFunctions(at, weights), n = 3;
      break;
    case VTK_QUADRATIC_QUAD:
    case VTK_BIQUADRATIC_QUAD:
      vtkQuad::InterpolationFunctions(at, weights), n = 4;
      break;
    case VTK_QUADRATIC_TETRA:
      vtkTetra::InterpolationFunctions(at, weights), n = 4;
      break;
    case VTK_QUADRATIC_PYRAMID:
      vtkPyramid::InterpolationFunctions(at, weights), n = 5;
      break;
    case VTK_QUADRATIC_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
      vtkWedge::InterpolationFunctions(at, weights), n = 6;
      break;
    case VTK_QUADRATIC_HEXAHEDRON:
    case VTK_TRIQUADRATIC_HEXAHEDRON:
      vtkHexahedron::InterpolationFunctions(at, weights), n = 8;
      break;
    default:
      return false;
  }
  vtkNew<vtkIdList> nodes;
  grid->GetCellPoints(cell, nodes);
  for (int c = 0; c < 3; ++c) {
    place[c] = 0;
    for (int i = 0; i < n; ++i) place[c] += weights[i] * grid->GetPoint(nodes->GetId(i))[c];
  }
  return true;
}

Grid block_of(vtkUnstructuredGrid *whole, int which, bool with_ids) {
  const Grid block = Grid::New();
  std::vector<vtkIdType> new_id(static_cast<std::size_t>(whole->GetNumberOfPoints()), -1);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("GlobalPointIds");
  block->AllocateEstimate(whole->GetNumberOfCells(), 8);
  vtkNew<vtkIdList> nodes;
  for (vtkIdType cell = which; cell < whole->GetNumberOfCells(); cell += 2) {
    whole->GetCellPoints(cell, nodes);
    for (vtkIdType i = 0; i < nodes->GetNumberOfIds(); ++i) {
      const vtkIdType node = nodes->GetId(i);
      vtkIdType &id = new_id[static_cast<std::size_t>(node)];
      if (id < 0) {
        id = points->InsertNextPoint(whole->GetPoint(node));
        ids->InsertNextValue(1000 + 3 * node);
      }
      nodes->SetId(i, id);
    }
    block->InsertNextCell(whole->GetCellType(cell), nodes);
  }
  block->SetPoints(points);
  if (with_ids) block->GetPointData()->SetGlobalIds(ids);
  return block;
}

}  // namespace

extern "C" {

int shim_compare_meshes(const char *a, const char *b, int how, int64_t counts[4]) {
  const Grid grids[2] = {read_grid(a), read_grid(b)};
  std::vector<std::string> points[2], cells[2];
  for (int i = 0; i < 2; ++i) {
    if (!grids[i] || grids[i]->GetNumberOfPoints() == 0) return 0;
    for (vtkIdType node = 0; node < grids[i]->GetNumberOfPoints(); ++node)
      points[i].push_back(bytes_of(grids[i], node, how));
    for (vtkIdType cell = 0; cell < grids[i]->GetNumberOfCells(); ++cell)
      cells[i].push_back(cell_of(grids[i], cell, how));
  }
  counts[0] = static_cast<int64_t>(points[0].size());
  counts[1] = static_cast<int64_t>(cells[0].size());
  counts[2] = n_different(points[0], points[1]);
  counts[3] = n_different(cells[0], cells[1]);
  return 1;
}

double shim_bend(const char *path, int64_t n_of_type[100]) {
  std::fill_n(n_of_type, 100, 0);
  const Grid grid = read_grid(path);
  if (!grid || grid->GetNumberOfPoints() == 0) return -1;
  double most = 0;
  for (vtkIdType id = 0; id < grid->GetNumberOfCells(); ++id) {
    const int type = grid->GetCellType(id);
    ++n_of_type[type];
    vtkCell *const cell = grid->GetCell(id);
    const double *const at = cell->GetParametricCoords();
    for (vtkIdType i = 0; at && i < cell->GetNumberOfPoints(); ++i) {
      double place[3], node[3];
      if (!linear_place(grid, id, type, at + 3 * i, place)) break;
      grid->GetPoint(cell->GetPointId(static_cast<int>(i)), node);
      most = std::max(most, std::hypot(place[0] - node[0], place[1] - node[1], place[2] - node[2]));
    }
  }
  return most;
}

int shim_write_exodus([[maybe_unused]] const char *path, [[maybe_unused]] const char *mesh) {
#ifdef RIIS_TEST_EXODUS
  const Grid grid = read_grid(mesh);
  vtkNew<vtkTypeInt32Array> blocks;
  blocks->SetName("ObjectId");
  // A block of an Exodus file has one type of cells.
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
    blocks->InsertNextValue(10 * grid->GetCellType(i) + (i % 2 == 0 ? 0 : 1));
  grid->GetCellData()->AddArray(blocks);
  vtkNew<vtkExodusIIWriter> writer;
  writer->SetInputData(grid);
  writer->SetFileName(path);
  writer->SetBlockIdArrayName("ObjectId");
  writer->SetStoreDoubles(1);
  return writer->Write();
#else
  return 0;
#endif
}

int shim_write_vtm(const char *path, const char *mesh, int with_ids) {
  const Grid whole = read_grid(mesh);
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int i = 0; i < 2; ++i) blocks->SetBlock(static_cast<unsigned>(i), block_of(whole, i, with_ids != 0));
  vtkNew<vtkXMLMultiBlockDataWriter> writer;
  writer->SetInputData(blocks);
  writer->SetFileName(path);
  return writer->Write();
}

}  // extern "C"
