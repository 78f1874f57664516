// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/point_arrays.hpp"

#include <algorithm>

#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "riis_vtk/array_names.hpp"
#include "riis_vtk/vtk_errors.hpp"

namespace riis::vtk {
namespace {

template <class Array>
vtkSmartPointer<Array> point_array(const std::string &name, vtkIdType n_points, int n_components = 1) {
  const auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(n_components);
  array->SetNumberOfTuples(n_points);
  return array;
}

void check_are_of_mesh(const riis_marks *marks, vtkIdType n_nodes) {
  riis_mark_stats stats{};
  check_core(riis_marks_get_stats(marks, &stats, sizeof stats));
  if (stats.n_nodes != n_nodes) {
    fail(RIIS_INVALID_ARGUMENT, "marks are of a mesh with " + std::to_string(stats.n_nodes) + " nodes, this mesh has " +
                                    std::to_string(n_nodes));
  }
}

// Refuses a name that some file format or some reader does not take.
void check_name(const char *argument, const std::string &name) {
  constexpr std::size_t longest = 64;
  const auto is_good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  if (name.empty() || name.size() > longest || !std::all_of(name.begin(), name.end(), is_good)) {
    fail(RIIS_INVALID_ARGUMENT, std::string(argument) + " is \"" + name.substr(0, longest) + "\"; it must be 1 to " +
                                    std::to_string(longest) + " letters, digits, _, - and .");
  }
}

// The nodes within the limit of a marking.
struct Within {
  std::int64_t n = 0;
  const std::int64_t *node_id = nullptr;
};

// Adds an array that has the values of the nodes within the limit, and `elsewhere` for the others.
template <class Array, class Value>
void add_field(vtkUnstructuredGrid *grid, const std::string &name, const Within &within, int n_components,
               const Value *values, Value elsewhere) {
  if (!values && within.n > 0) fail(RIIS_INVALID_ARGUMENT, "marks lack the field of " + name);
  const auto array = point_array<Array>(name, grid->GetNumberOfPoints(), n_components);
  Value *const to = array->GetPointer(0);
  std::fill_n(to, n_components * grid->GetNumberOfPoints(), elsewhere);
  for (std::int64_t i = 0; i < within.n; ++i)
    std::copy_n(values + n_components * i, n_components, to + n_components * within.node_id[i]);
  grid->GetPointData()->AddArray(array);
}

void check_fields(std::int32_t fields) {
  constexpr std::int32_t all = 2 * RIIS_FIELD_PATCH - 1;
  if (fields >= 0 && fields <= all) return;
  fail(RIIS_INVALID_ARGUMENT, "fields is " + std::to_string(fields) + "; it must be a sum of RIIS_FIELD_*");
}

}  // namespace

void set_marks(vtkUnstructuredGrid *grid, const riis_marks *marks, double far_distance, const std::string &prefix) {
  check_name("prefix", prefix);
  const vtkIdType n = grid->GetNumberOfPoints();
  check_are_of_mesh(marks, n);
  const auto marked = point_array<vtkUnsignedCharArray>(prefix + "_marked", n);
  const auto distance = point_array<vtkDoubleArray>(prefix + "_distance", n);
  const auto leaflet = point_array<vtkTypeInt32Array>(prefix + "_leaflet", n);
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
    grid->GetPointData()->AddArray(array);
  }
}

void set_point_array(vtkUnstructuredGrid *grid, const std::string &name, std::int64_t n_nodes,
                     std::int64_t n_components, const double *values) {
  check_name("name", name);
  const vtkIdType n = grid->GetNumberOfPoints();
  if (n_nodes != n)
    fail(RIIS_INVALID_ARGUMENT,
         "n_nodes is " + std::to_string(n_nodes) + "; the mesh has " + std::to_string(n) + " nodes");
  if (n_components < 1 || n_components > 9)
    fail(RIIS_INVALID_ARGUMENT, "n_components is " + std::to_string(n_components) + "; it must be from 1 to 9");
  const auto array = point_array<vtkDoubleArray>(name, n, static_cast<int>(n_components));
  std::copy_n(values, n * n_components, array->GetPointer(0));
  grid->GetPointData()->AddArray(array);
}

void set_fields(vtkUnstructuredGrid *grid, const riis_marks *marks, std::int32_t fields, const std::string &prefix) {
  check_name("prefix", prefix);
  check_fields(fields);
  check_are_of_mesh(marks, grid->GetNumberOfPoints());
  riis_mark_list of{};
  check_core(riis_marks_get_list(marks, RIIS_LIST_WITHIN_LIMIT, &of, sizeof of));
  const Within within{of.n_nodes, of.node_id};
  const auto add_doubles = [&](std::int32_t field, const char *name, int n_components, const double *values) {
    if (fields & field) add_field<vtkDoubleArray>(grid, prefix + name, within, n_components, values, 0.0);
  };
  const auto add_integers = [&](std::int32_t field, const char *name, const std::int32_t *values,
                                std::int32_t elsewhere) {
    if (fields & field) add_field<vtkTypeInt32Array>(grid, prefix + name, within, 1, values, elsewhere);
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

}  // namespace riis::vtk
