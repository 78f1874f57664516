// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/surface_polydata.hpp"

#include <algorithm>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>

#include "riis_vtk/array_names.hpp"
#include "riis_vtk/vtk_errors.hpp"

namespace riis::vtk {
namespace {

template <class Array, class Value>
vtkSmartPointer<Array> array_of(const char *name, const Value *values, int n_components, int64_t n_tuples) {
  const auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(n_components);
  array->SetNumberOfTuples(n_tuples);
  std::copy_n(values, n_components * n_tuples, array->GetPointer(0));
  return array;
}

void add_vertices(const riis_triangles &of, vtkPolyData *data) {
  const int64_t n = of.n_vertices;
  vtkNew<vtkPoints> points;
  points->SetData(array_of<vtkDoubleArray>("Points", of.xyz, 3, n));
  data->SetPoints(points);
  if (of.uv) data->GetPointData()->AddArray(array_of<vtkDoubleArray>(uv_array, of.uv, 2, n));
  if (of.velocity) data->GetPointData()->AddArray(array_of<vtkDoubleArray>(velocity_array, of.velocity, 3, n));
}

void add_triangles(const riis_triangles &of, vtkPolyData *data) {
  const auto &[n_vertices, xyz, uv, velocity, n, vertex_id, triangle_id, leaflet_id, patch_id] = of;
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateExact(n, 3 * n);
  for (int64_t i = 0; i < n; ++i) {
    const vtkIdType corners[3] = {vertex_id[3 * i], vertex_id[3 * i + 1], vertex_id[3 * i + 2]};
    triangles->InsertNextCell(3, corners);
  }
  data->SetPolys(triangles);
  data->GetCellData()->AddArray(array_of<vtkTypeInt32Array>(leaflet_array, leaflet_id, 1, n));
  data->GetCellData()->AddArray(array_of<vtkTypeInt32Array>(patch_array, patch_id, 1, n));
  data->GetCellData()->AddArray(array_of<vtkTypeInt64Array>(triangle_array, triangle_id, 1, n));
}

}  // namespace

vtkSmartPointer<vtkPolyData> polydata_of(const riis_surface *surface) {
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  riis_triangles triangles{};
  check_core(riis_surface_get_triangles(surface, &triangles, sizeof triangles));
  add_vertices(triangles, data);
  add_triangles(triangles, data);
  return data;
}

}  // namespace riis::vtk
