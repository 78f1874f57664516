// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolygon.h>

#include "riis_vtk/array_names.hpp"
#include "riis_vtk/vtk_errors.hpp"

namespace riis::vtk {
namespace {

[[noreturn]] void fail_cell(const std::string &path, vtkIdType cell_id, const std::string &reason) {
  fail_file(path, "cell " + std::to_string(cell_id) + " " + reason);
}

void add_triangle(std::vector<std::int64_t> &triangles, const vtkIdList *ids, vtkIdType a, vtkIdType b, vtkIdType c) {
  auto *list = const_cast<vtkIdList *>(ids);
  triangles.insert(triangles.end(), {list->GetId(a), list->GetId(b), list->GetId(c)});
}

void cut_strip(const vtkIdList *ids, std::vector<std::int64_t> &triangles) {
  // Every other triangle of a strip runs the other way round.
  for (vtkIdType i = 0; i + 2 < const_cast<vtkIdList *>(ids)->GetNumberOfIds(); ++i) {
    add_triangle(triangles, ids, i, i % 2 == 0 ? i + 1 : i + 2, i % 2 == 0 ? i + 2 : i + 1);
  }
}

void cut_polygon(const std::string &path, vtkPointSet *data, vtkIdType cell_id, vtkIdList *ids,
                 std::vector<std::int64_t> &triangles) {
  vtkNew<vtkPolygon> polygon;
  polygon->Initialize(static_cast<int>(ids->GetNumberOfIds()), ids->GetPointer(0), data->GetPoints());
  vtkNew<vtkIdList> corners;
  const bool cut = polygon->Triangulate(corners) != 0;
  if (!cut || corners->GetNumberOfIds() != 3 * (ids->GetNumberOfIds() - 2)) {
    fail_cell(path, cell_id, "is a polygon that cannot be cut into triangles");
  }
  for (vtkIdType i = 0; i < corners->GetNumberOfIds(); i += 3) {
    add_triangle(triangles, ids, corners->GetId(i), corners->GetId(i + 1), corners->GetId(i + 2));
  }
}

// Twice the vector area of the triangle of three corners.
std::array<double, 3> area_of(vtkPointSet *data, const vtkIdList *ids, vtkIdType a, vtkIdType b, vtkIdType c) {
  auto *list = const_cast<vtkIdList *>(ids);
  double p[3], q[3], r[3], area[3];
  data->GetPoint(list->GetId(a), p);
  data->GetPoint(list->GetId(b), q);
  data->GetPoint(list->GetId(c), r);
  vtkMath::Subtract(q, p, q);
  vtkMath::Subtract(r, p, r);
  vtkMath::Cross(q, r, area);
  return {area[0], area[1], area[2]};
}

// Tells whether the diagonal from corner i to the opposite corner cuts a quad into two triangles that face the same way.
bool is_inner_diagonal(vtkPointSet *data, const vtkIdList *ids, vtkIdType i) {
  const std::array<double, 3> one = area_of(data, ids, i, i + 1, i + 2);
  const std::array<double, 3> other = area_of(data, ids, i, i + 2, (i + 3) % 4);
  return vtkMath::Dot(one.data(), other.data()) > 0;
}

// Quads are cut from their first corner to their third, here and in the core. If that line runs outside a concave quad and the
// other diagonal runs inside, the corners move on by one.
void put_inner_diagonal_first(vtkPointSet *data, vtkIdList *ids) {
  if (!is_inner_diagonal(data, ids, 0) && is_inner_diagonal(data, ids, 1)) {
    std::rotate(ids->begin(), ids->begin() + 1, ids->end());
  }
}

// Appends the triangles of one cell.
void cut_cell(const std::string &path, vtkPointSet *data, vtkIdType cell_id, vtkIdList *ids,
              std::vector<std::int64_t> &triangles) {
  const int type = data->GetCellType(cell_id);
  const vtkIdType n = ids->GetNumberOfIds();
  if (type == VTK_TRIANGLE_STRIP && n >= 3) {
    cut_strip(ids, triangles);
  } else if (type == VTK_TRIANGLE || (type == VTK_POLYGON && n == 3)) {
    add_triangle(triangles, ids, 0, 1, 2);
  } else if (type == VTK_QUAD || (type == VTK_POLYGON && n == 4)) {
    put_inner_diagonal_first(data, ids);
    add_triangle(triangles, ids, 0, 1, 2);
    add_triangle(triangles, ids, 0, 2, 3);
  } else if (type == VTK_POLYGON && n > 4) {
    cut_polygon(path, data, cell_id, ids, triangles);
  } else {
    fail_cell(path, cell_id,
              std::string("is a ") + vtkCellTypes::GetClassNameFromTypeId(type) + " with " + std::to_string(n) +
                  " points; a surface has triangles, quads, polygons and triangle strips");
  }
}

bool holds_quads_only(vtkPointSet *data) {
  for (vtkIdType cell_id = 0; cell_id < data->GetNumberOfCells(); ++cell_id) {
    if (data->GetCellType(cell_id) != VTK_QUAD) return false;
  }
  return true;
}

// Returns one leaflet id per cell, or none if there is no such array. Fails if that array is required.
std::vector<std::int32_t> leaflets_of_cells(const std::string &path, vtkPointSet *data,
                                            const std::string &leaflets_name, bool is_required) {
  const std::string name = "cell array " + leaflets_name;
  vtkAbstractArray *abstract = data->GetCellData()->GetAbstractArray(leaflets_name.c_str());
  if (!abstract && is_required) fail_file(path, "has no " + name + list_of_arrays(data->GetCellData()));
  if (!abstract) return {};
  vtkDataArray *array = vtkDataArray::SafeDownCast(abstract);
  if (!array || array->GetNumberOfComponents() != 1) fail_file(path, name + " must hold one number a cell");
  if (array->GetNumberOfTuples() != data->GetNumberOfCells()) {
    fail_file(path, name + " has " + std::to_string(array->GetNumberOfTuples()) + " values for " +
                        std::to_string(data->GetNumberOfCells()) + " cells");
  }
  std::vector<std::int32_t> leaflets;
  for (vtkIdType cell_id = 0; cell_id < data->GetNumberOfCells(); ++cell_id) {
    const double value = array->GetTuple1(cell_id);
    if (!(value >= 0 && value <= std::numeric_limits<std::int32_t>::max()) || value != std::floor(value)) {
      fail_file(path, name + ": cell " + std::to_string(cell_id) + " has " + std::to_string(value) +
                          ", not a whole number from 0 to 2147483647");
    }
    leaflets.push_back(static_cast<std::int32_t>(value));
  }
  return leaflets;
}

}  // namespace

std::vector<double> coordinates_of(vtkPointSet *data) {
  const vtkIdType n = data->GetNumberOfPoints();
  std::vector<double> xyz(static_cast<std::size_t>(3 * n));
  for (vtkIdType i = 0; i < n; ++i) data->GetPoint(i, xyz.data() + 3 * i);
  return xyz;
}

Faces faces_of(const std::string &path, vtkPointSet *data, const std::string &leaflets_name, bool is_required) {
  if (data->GetNumberOfCells() == 0) fail_file(path, "holds no faces");
  const std::vector<std::int32_t> leaflets = leaflets_of_cells(path, data, leaflets_name, is_required);
  Faces faces;
  faces.xyz = coordinates_of(data);
  faces.corners_per_face = holds_quads_only(data) ? 4 : 3;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell_id = 0; cell_id < data->GetNumberOfCells(); ++cell_id) {
    data->GetCellPoints(cell_id, ids);
    if (faces.corners_per_face == 4) {
      put_inner_diagonal_first(data, ids);
      faces.vertex_ids.insert(faces.vertex_ids.end(), ids->begin(), ids->end());
    } else {
      cut_cell(path, data, cell_id, ids, faces.vertex_ids);
    }
    const std::size_t n_faces = faces.vertex_ids.size() / static_cast<std::size_t>(faces.corners_per_face);
    if (!leaflets.empty()) faces.leaflet_id.resize(n_faces, leaflets[static_cast<std::size_t>(cell_id)]);
  }
  return faces;
}

}  // namespace riis::vtk
