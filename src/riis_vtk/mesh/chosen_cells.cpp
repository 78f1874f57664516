// SPDX-License-Identifier: Apache-2.0
// Domains of a mesh, such as the fluid and the wall. A domain consists of the cells that have the same value in a cell array.
// This file keeps only the cells of certain domains, or finds the domains that touch each other.
#include <riis/riis_vtk.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>

#include "common/array_view.hpp"
#include "riis_vtk/base/files.hpp"
#include "riis_vtk/mesh/mesh.hpp"
#include "riis_vtk/mesh/outside_faces.hpp"
#include "riis_vtk/read/other_files.hpp"

namespace riis::vtk {
namespace {

bool is_volume(vtkUnstructuredGrid *grid, vtkIdType cell) { return shape_of(grid->GetCellType(cell)).dimension == 3; }

// ---- The choice ----

// A choice of cells, "NAME=VALUES", in which commas separate the values.
struct Where {
  std::string name;
  std::vector<std::string> values;
};

Where parsed(const std::string &text) {
  const std::size_t equals = text.rfind('=');
  const auto refuse = [&] { refuse_argument("where is \"", text, "\"; it must be NAME=VALUES, such as region=1,2"); };
  if (equals == std::string::npos || equals == 0) refuse();
  Where where{text.substr(0, equals), {}};
  for (std::size_t begin = equals + 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end == begin) refuse();
    where.values.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  if (where.values.empty()) refuse();
  return where;
}

vtkDataArray *numbers_of_cells(vtkUnstructuredGrid *grid, const std::string &name) {
  auto *const array = vtkDataArray::SafeDownCast(grid->GetCellData()->GetAbstractArray(name.c_str()));
  return array && array->GetNumberOfComponents() == 1 ? array : nullptr;
}

// A cell from gmsh may belong to several physical groups. The arrays for further groups come after the array for the first group.
std::vector<vtkDataArray *> arrays_of(vtkUnstructuredGrid *grid, const std::string &name) {
  std::vector<vtkDataArray *> arrays;
  vtkDataArray *next = numbers_of_cells(grid, name);
  if (!next)
    refuse_argument("where: the mesh has no cell array ", name, " of single numbers",
                    list_of_arrays(grid->GetCellData()));
  for (int k = 2; next; ++k) {
    arrays.push_back(next);
    next = name == physical_array ? numbers_of_cells(grid, joined(name, "_", k)) : nullptr;
  }
  return arrays;
}

std::string names_text(std::vector<RegionName> names) {
  std::sort(names.begin(), names.end(), [](const RegionName &a, const RegionName &b) { return a.number < b.number; });
  std::string text;
  for (const RegionName &of : names) text += (text.empty() ? "" : ", ") + of.name;
  return text;
}

std::set<double> numbers_of(const Where &where, const std::vector<RegionName> &names) {
  std::set<double> numbers;
  for (const std::string &value : where.values) {
    double number = 0;
    const auto name = std::find_if(names.begin(), names.end(), [&](const RegionName &of) {
      return where.name == physical_array && of.name == value;
    });
    if (name != names.end())
      number = name->number;
    else if (!read_number(value, number))
      refuse_argument("where: ", value, " is not a number",
                      names.empty() ? "" : ", nor the name of a physical group of volumes: those are ",
                      names_text(names));
    numbers.insert(number);
  }
  return numbers;
}

// Returns as text the first values that volume cells have in these arrays.
std::string values_text(vtkUnstructuredGrid *grid, const std::vector<vtkDataArray *> &arrays) {
  constexpr std::size_t most_listed = 10;
  std::set<double> values;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells() && values.size() <= most_listed; ++cell)
    if (is_volume(grid, cell))
      for (vtkDataArray *const array : arrays)
        if (const double value = array->GetTuple1(cell); array == arrays[0] || value != 0) values.insert(value);
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + joined(value);
  return values.size() > most_listed ? text + ", ..." : text;
}

void choose_cells(riis_vtk_mesh &mesh, const Where &where, std::int64_t *n_chosen) {
  vtkUnstructuredGrid *const grid = mesh.grid();
  if (n_chosen) *n_chosen = 0;
  if (n_chosen && grid->GetNumberOfCells() == 0) return;  // an empty piece may lack the array
  const std::vector<vtkDataArray *> arrays = arrays_of(grid, where.name);
  const std::set<double> wanted = numbers_of(where, mesh.region_names);
  const bool needs_volumes = largest_dimension(grid) == 3;
  std::vector<vtkIdType> cells;
  std::int64_t n = 0;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    if (std::none_of(arrays.begin(), arrays.end(),
                     [&](vtkDataArray *array) { return wanted.count(array->GetTuple1(cell)) != 0; }))
      continue;
    cells.push_back(cell);
    n += !needs_volumes || is_volume(grid, cell);
  }
  if (n_chosen)
    *n_chosen = n;
  else if (n == 0)
    refuse_argument("where: no ", needs_volumes ? "volume cell" : "cell", " has such a value of ", where.name,
                    needs_volumes ? "; they have " + values_text(grid, arrays) : "");
  keep_cells(mesh, cells);
}

// ---- Regions ----

// Returns false if the array's name contains a word that seldom names domains.
bool may_tell_domains(const std::string &array_name) {
  std::string name = array_name;
  for (char &c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  static const char *const others[] = {"riis_",    "vtk",    "ghost", "rank",   "proc",  "part", "thread",
                                       "color",    "colour", "level", "qual",   "type",  "flag", "_marked",
                                       "_leaflet", "_side",  "_rim",  "_patch", "leaf_", "error"};
  return std::none_of(std::begin(others), std::end(others),
                      [&](const char *word) { return name.find(word) != std::string::npos; });
}

constexpr std::size_t most_regions = 16;

// Returns the values that volume cells have in an array, if they may number domains: the values are few whole numbers, and some
// cells with different values touch. Otherwise returns no values. Two cells touch if they have the same type and a common node.
// The types are compared because Exodus needs a block for each type, so the blocks of one domain may have different values.
std::vector<double> touching_values(vtkUnstructuredGrid *grid, vtkDataArray *array) {
  std::set<double> values;
  // For each node, the value and the type of its first cell.
  std::vector<double> of_node(static_cast<std::size_t>(grid->GetNumberOfPoints()), NAN);
  std::vector<int> type_at(of_node.size());
  bool do_touch = false;
  vtkNew<vtkIdList> nodes;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    if (!is_volume(grid, cell)) continue;
    const double value = array->GetTuple1(cell);
    values.insert(value);
    if (value != std::floor(value) || values.size() > most_regions) return {};
    grid->GetCellPoints(cell, nodes);
    const int type = grid->GetCellType(cell);
    for (const vtkIdType node : *nodes) {
      double &of = view(of_node)[node];
      if (std::isnan(of)) {
        of = value;
        view(type_at)[node] = type;
      }
      do_touch = do_touch || (of != value && view(type_at)[node] == type);
    }
  }
  if (!do_touch) return {};
  return {values.begin(), values.end()};
}

// Does the same as touching_values for a mesh given by axes. In a mesh given by axes, different values always touch, because each
// cell is beside the next cell.
std::vector<double> values_on_axes(vtkDataArray *array) {
  std::set<double> values;
  for (vtkIdType cell = 0; cell < array->GetNumberOfTuples(); ++cell) {
    const double value = array->GetTuple1(cell);
    values.insert(value);
    if (value != std::floor(value) || values.size() > most_regions) return {};
  }
  if (values.size() < 2) return {};
  return {values.begin(), values.end()};
}

void find_regions(riis_vtk_mesh &mesh) {
  mesh.regions = {};
  vtkCellData *const data = mesh.data->GetCellData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    vtkDataArray *const array = data->GetArray(i);
    if (!array || !array->GetName() || array->GetNumberOfComponents() != 1 || !may_tell_domains(array->GetName()))
      continue;
    mesh.regions.values = mesh.axes ? values_on_axes(array) : touching_values(mesh.grid(), array);
    mesh.regions.array = array->GetName();
    if (!mesh.regions.values.empty()) return;
  }
  mesh.regions = {};
}

}  // namespace
}  // namespace riis::vtk

using namespace riis::vtk;

extern "C" {

RIIS_API riis_status riis_vtk_mesh_choose_cells(riis_vtk_mesh *mesh, const char *where, int64_t *n_chosen) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    if (mesh->centers) refuse_argument("the nodes of mesh are already the centres of cells");
    choose_cells(*mesh, parsed(require(where, "where")), n_chosen);
  });
}

RIIS_API riis_status riis_vtk_mesh_find_regions(riis_vtk_mesh *mesh, const char **array, int64_t *n_values,
                                                const double **values) {
  return guarded([&](const CaughtOutput &) {
    find_regions(*require(mesh, "mesh"));
    *require(array, "array") = mesh->regions.array.c_str();
    *require(n_values, "n_values") = static_cast<int64_t>(mesh->regions.values.size());
    if (values) *values = mesh->regions.values.data();
  });
}

}  // extern "C"
