// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/read/structured_files.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkRectilinearGridReader.h>
#include <vtkStructuredGrid.h>
#include <vtkStructuredGridReader.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsReader.h>
#include <vtkTypeInt64Array.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLRectilinearGridReader.h>
#include <vtkXMLStructuredGridReader.h>

#include "common/array_view.hpp"
#include "riis_vtk/read/other_files.hpp"
#include "riis_vtk/read/watched_reader.hpp"

namespace riis::vtk {
namespace {

// Returns the corners of the first cell of the grid. The corners of any cell are the first cell's corners plus the number of the
// cell's first node.
std::vector<std::int64_t> corners_of_first(const std::array<std::int64_t, 3> &n) {
  std::vector<std::int64_t> corners = {0};
  std::int64_t stride = 1;
  for (const std::int64_t size : n) {
    if (size == 1) continue;
    std::vector<std::int64_t> opposite = corners;
    for (std::int64_t &corner : opposite) corner += stride;
    // The corners of a quad must be listed in their order round the quad.
    if (opposite.size() == 2) std::swap(opposite[0], opposite[1]);
    corners.insert(corners.end(), opposite.begin(), opposite.end());
    stride *= size;
  }
  return corners;
}

// Returns whether the corners of a hexahedron have the wrong orientation. The orientation is wrong if an odd number of axes
// descend.
bool is_turned_over(vtkPoints *points, const std::vector<std::int64_t> &corners) {
  double at[4][3], side[3][3];
  constexpr std::size_t of[4] = {0, 1, 3, 4};
  for (std::size_t k = 0; k < 4; ++k) points->GetPoint(corners[of[k]], at[k]);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < 3; ++c) side[k][c] = at[k + 1][c] - at[0][c];
  double volume = 0;
  for (std::size_t c = 0; c < 3; ++c)
    volume += side[0][c] * (side[1][(c + 1) % 3] * side[2][(c + 2) % 3] - side[1][(c + 2) % 3] * side[2][(c + 1) % 3]);
  return volume < 0;
}

}  // namespace

void add_structured_cells(vtkUnstructuredGrid *grid, const std::array<std::int64_t, 3> &n) {
  std::vector<std::int64_t> corners = corners_of_first(n);
  constexpr std::size_t of_hexahedron = 8;
  if (corners.size() == of_hexahedron && is_turned_over(grid->GetPoints(), corners))
    std::rotate(corners.begin(), corners.begin() + of_hexahedron / 2, corners.end());
  static const std::map<std::size_t, int> types = {
      {1, VTK_VERTEX}, {2, VTK_LINE}, {4, VTK_QUAD}, {of_hexahedron, VTK_HEXAHEDRON}};
  std::array<std::int64_t, 3> n_cells{};
  for (std::size_t axis = 0; axis < 3; ++axis) n_cells[axis] = std::max<std::int64_t>(n[axis] - 1, 1);
  const std::int64_t n_all = n_cells[0] * n_cells[1] * n_cells[2], n_corners = view(corners).size();
  vtkNew<vtkTypeInt64Array> offsets, ids;
  offsets->SetNumberOfTuples(n_all + 1);
  ids->SetNumberOfTuples(n_all * n_corners);
  for (std::int64_t cell = 0; cell <= n_all; ++cell) offsets->SetValue(cell, cell * n_corners);
  vtkTypeInt64 *to = ids->GetPointer(0);
  for (std::int64_t k = 0; k < n_cells[2]; ++k)
    for (std::int64_t j = 0; j < n_cells[1]; ++j)
      for (std::int64_t i = 0; i < n_cells[0]; ++i)
        for (const std::int64_t corner : corners) *to++ = i + n[0] * (j + n[1] * k) + corner;
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, ids);
  grid->SetCells(types.at(corners.size()), cells);
}

void share_arrays(vtkDataSet *from, vtkDataSet *to) {
  to->GetPointData()->ShallowCopy(from->GetPointData());
  to->GetCellData()->ShallowCopy(from->GetCellData());
  to->GetFieldData()->ShallowCopy(from->GetFieldData());
}

namespace {

using Sizes = std::array<std::int64_t, 3>;

template <class DataSet>
Sizes sizes_of(DataSet *data) {
  int sizes[3];
  data->GetDimensions(sizes);
  return {sizes[0], sizes[1], sizes[2]};
}

// Returns the axes if each axis is finite, strictly ascends and has at least two nodes. Otherwise returns NULL.
std::unique_ptr<const GridAxes> usable(GridAxes axes) {
  for (const std::vector<double> &axis : axes.of) {
    const bool ascends =
        std::adjacent_find(axis.begin(), axis.end(), [](double a, double b) { return !(a < b); }) == axis.end();
    if (axis.size() < 2 || !ascends || !std::isfinite(axis.front()) || !std::isfinite(axis.back())) return nullptr;
  }
  return std::make_unique<const GridAxes>(std::move(axes));
}

std::unique_ptr<const GridAxes> axes_of(vtkImageData *data) {
  if (!data->GetDirectionMatrix()->IsIdentity()) return nullptr;
  GridAxes axes;
  GridAxes::Image &image = axes.image.emplace();
  const Sizes n = sizes_of(data);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    image.origin[axis] = data->GetOrigin()[axis];
    image.spacing[axis] = data->GetSpacing()[axis];
    image.first[axis] = data->GetExtent()[2 * axis];
    for (std::int64_t i = 0; i < n[axis]; ++i) {
      // The product is rounded before the origin is added.
      const double step = static_cast<double>(image.first[axis] + i) * image.spacing[axis];
      axes.of[axis].push_back(image.origin[axis] + step);
    }
  }
  return usable(std::move(axes));
}

std::unique_ptr<const GridAxes> axes_of(vtkRectilinearGrid *data) {
  GridAxes axes;
  vtkDataArray *const coordinates[3] = {data->GetXCoordinates(), data->GetYCoordinates(), data->GetZCoordinates()};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (vtkIdType i = 0; i < coordinates[axis]->GetNumberOfTuples(); ++i)
      axes.of[axis].push_back(coordinates[axis]->GetComponent(i, 0));
  return usable(std::move(axes));
}

std::unique_ptr<const GridAxes> axes_of(vtkStructuredGrid *) { return nullptr; }

bool is_single(vtkImageData *) { return false; }
bool is_single(vtkRectilinearGrid *data) { return data->GetXCoordinates()->GetDataType() == VTK_FLOAT; }
bool is_single(vtkStructuredGrid *data) { return data->GetPoints()->GetDataType() == VTK_FLOAT; }

// Fails if an axis of a grid has more or fewer coordinates than nodes. VTK would trust the stated number of nodes.
void check_axes(const std::string &path, vtkRectilinearGrid *data) {
  const Sizes n = sizes_of(data);
  vtkDataArray *const coordinates[3] = {data->GetXCoordinates(), data->GetYCoordinates(), data->GetZCoordinates()};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const vtkIdType n_held = coordinates[axis] ? coordinates[axis]->GetNumberOfTuples() : 0;
    if (n_held != n[axis])
      fail_file(path, "has ", n_held, " coordinates along ", std::string(1, "xyz"[axis]), " for ", n[axis], " nodes");
  }
}
void check_axes(const std::string &, vtkImageData *) {}
void check_axes(const std::string &path, vtkStructuredGrid *data) {
  if (!data->GetPoints()) fail_file(path, "holds no points");
}

// Fails if a grid needs far more memory than its file has bytes. An image may state any size, because it stores no coordinates.
void check_claim(const std::string &path, const Sizes &n, bool has_axes) {
  constexpr double base = 2e9, per_byte = 1000, bytes_of_coordinate = 8, bytes_of_node = 100;
  double n_all = 1, n_along = 0;
  for (const std::int64_t size : n) {
    n_all *= static_cast<double>(size);
    n_along += static_cast<double>(size);
  }
  const double needed = has_axes ? bytes_of_coordinate * n_along : bytes_of_node * n_all;
  if (needed > base + per_byte * static_cast<double>(check_readable(path)))
    fail_file(path, "claims ", n[0], " times ", n[1], " times ", n[2], " points, which need memory of ", needed,
              " bytes");
}

template <class DataSet>
StructuredFile file_of(const std::string &path, DataSet *data) {
  if (data->GetNumberOfPoints() == 0) fail_file(path, "holds no points");
  check_axes(path, data);
  check_claim(path, sizes_of(data), true);
  check_array_lengths(path, data->GetPointData(), "point", data->GetNumberOfPoints());
  check_array_lengths(path, data->GetCellData(), "cell", data->GetNumberOfCells());
  StructuredFile made{vtkSmartPointer<vtkUnstructuredGrid>::New(), axes_of(data)};
  share_arrays(data, made.data);
  if (is_single(data)) add_note(made.data, "its points have single precision");
  if (made.axes) return made;
  check_claim(path, sizes_of(data), false);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    double point[3];
    data->GetPoint(i, point);
    points->SetPoint(i, point);
  }
  made.data->SetPoints(points);
  add_structured_cells(made.data, sizes_of(data));
  return made;
}

template <class Reader, class DataSet>
StructuredFile read_xml_file(const std::string &path, const char *type, const CaughtOutput &caught) {
  check_xml(path, type);
  const auto data = read_xml<WatchedReader<Reader>, DataSet>(path, caught);
  return file_of<DataSet>(path, data);
}

template <class Reader, class DataSet>
StructuredFile read_legacy_file(const std::string &path, const LegacyContent &content, const CaughtOutput &caught) {
  const auto data = read_scanned<Reader, DataSet>(path, content, caught);
  return file_of<DataSet>(path, data);
}

}  // namespace

bool is_structured(const std::string &path) {
  const std::string ending = ending_of(path);
  return ending == "vti" || ending == "vtr" || ending == "vts" || (ending == "vtk" && is_structured_legacy(path));
}

StructuredFile read_structured(const std::string &path, const CaughtOutput &caught) {
  const std::string ending = ending_of(path);
  if (ending == "vti") return read_xml_file<vtkXMLImageDataReader, vtkImageData>(path, "ImageData", caught);
  if (ending == "vtr")
    return read_xml_file<vtkXMLRectilinearGridReader, vtkRectilinearGrid>(path, "RectilinearGrid", caught);
  if (ending == "vts")
    return read_xml_file<vtkXMLStructuredGridReader, vtkStructuredGrid>(path, "StructuredGrid", caught);
  const LegacyContent content = check_legacy(path, LegacyKinds::grid);
  if (content.kind == LegacyKind::structured_points)
    return read_legacy_file<vtkStructuredPointsReader, vtkStructuredPoints>(path, content, caught);
  if (content.kind == LegacyKind::rectilinear_grid)
    return read_legacy_file<vtkRectilinearGridReader, vtkRectilinearGrid>(path, content, caught);
  return read_legacy_file<vtkStructuredGridReader, vtkStructuredGrid>(path, content, caught);
}

}  // namespace riis::vtk
