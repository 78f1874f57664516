// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>

#include "common/array_view.hpp"
#include "common/message.hpp"
#include "riis_vtk/array_names.hpp"
#include "riis_vtk/files.hpp"
#include "riis_vtk/frame_checks.hpp"
#include "riis_vtk/surface_data.hpp"

namespace riis::vtk {
namespace {

struct Displacement {
  std::int64_t number;
  std::string name;
  vtkDataArray *array;  // of the data set
};

// Returns the number in a name of the form PREFIX_12 or PREFIX12, or -1 for another name.
std::int64_t number_in(const std::string &name, const std::string &prefix) {
  if (name.rfind(prefix, 0) != 0) return -1;
  const std::size_t begin = prefix.size() + (name.size() > prefix.size() && name[prefix.size()] == '_' ? 1 : 0);
  std::int64_t number = -1;
  const char *const last = name.data() + name.size();
  const auto [end, error] = std::from_chars(name.data() + begin, last, number);
  return error == std::errc() && end == last && name[begin] != '-' ? number : -1;
}

vtkDataArray *displacements_in(const std::string &path, vtkAbstractArray *abstract, const std::string &name) {
  vtkDataArray *array = vtkDataArray::SafeDownCast(abstract);
  if (!array) fail_file(path, "point array " + name + " holds no numbers");
  if (array->GetNumberOfComponents() != 3)
    fail_file(path, Message("point array ", name, " has ", array->GetNumberOfComponents(),
                            " components; displacements have 3")
                        .text());
  return array;
}

// Returns the arrays by their numbers, which are all different.
std::vector<Displacement> displacements_of(const std::string &path, vtkPointSet *data, const std::string &prefix) {
  std::vector<Displacement> found;
  for (int i = 0; i < data->GetPointData()->GetNumberOfArrays(); ++i) {
    vtkAbstractArray *abstract = data->GetPointData()->GetAbstractArray(i);
    const std::string name = abstract->GetName() ? abstract->GetName() : "";
    const std::int64_t number = number_in(name, prefix);
    if (number >= 0) found.push_back({number, name, displacements_in(path, abstract, name)});
  }
  if (found.empty())
    fail_file(path, "has no point array " + prefix + "_0, " + prefix + "_1, ..." + list_of_arrays(data->GetPointData()));
  std::sort(found.begin(), found.end(), [](const auto &a, const auto &b) { return a.number < b.number; });
  for (std::size_t i = 1; i < found.size(); ++i)
    if (found[i].number == found[i - 1].number)
      fail_file(path, "has the point arrays " + found[i - 1].name + " and " + found[i].name + " with the same number");
  return found;
}

std::vector<double> times_in_file(const std::string &path, vtkPointSet *data, const std::string &prefix, std::int64_t n) {
  vtkAbstractArray *abstract = data->GetFieldData()->GetAbstractArray(time_array);
  if (!abstract)
    fail_file(path, std::string("has no field array ") + time_array + ", and no times are given" +
                        list_of_arrays(data->GetFieldData()));
  vtkDataArray *array = vtkDataArray::SafeDownCast(abstract);
  if (!array || array->GetNumberOfValues() != n)
    fail_file(path, Message("field array ", time_array, " has ", array ? array->GetNumberOfValues() : 0,
                            " numbers, for ", n, " point arrays ", prefix, "_*")
                        .text());
  std::vector<double> times;
  const int n_components = array->GetNumberOfComponents();
  for (vtkIdType i = 0; i < n; ++i) times.push_back(array->GetComponent(i / n_components, static_cast<int>(i % n_components)));
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!is_time(times[i]))
      fail_file(path, Message("value ", i, " of field array ", time_array, " is ", times[i],
                              "; it must be finite and at most 1e30 in magnitude")
                          .text());
    if (i > 0 && !(times[i] > times[i - 1]))
      fail_file(path, Message("value ", i, " of field array ", time_array, " is ", times[i],
                              ", which is not above the one before, ", times[i - 1])
                          .text());
  }
  return times;
}

void add_displaced(const std::string &path, Frames &frames, const Displacement &displacement) {
  std::vector<double> xyz = frames.faces.xyz;
  for (std::size_t point = 0; 3 * point < xyz.size(); ++point) {
    double by[3];
    displacement.array->GetTuple(static_cast<vtkIdType>(point), by);
    for (std::size_t k = 0; k < 3; ++k) xyz[3 * point + k] += by[k];
  }
  check_places(path, xyz, ", displaced by " + displacement.name + ",");
  add_frame(frames, xyz);
}

}  // namespace

Frames frames_of_displacements(const std::string &path, const std::string &prefix, const std::vector<double> *times,
                               const LeafletArray &leaflets, const CaughtOutput &caught) {
  const std::string ending = ending_of(path);
  if (ending != "vtp" && ending != "vtu") fail_file(path, "displacements are in a .vtp or .vtu file");
  const vtkSmartPointer<vtkPointSet> data = read_surface_data(path, caught);
  const std::vector<Displacement> displacements = displacements_of(path, data, prefix);
  const std::int64_t n = view(displacements).size();
  if (times && view(*times).size() != n)
    fail(RIIS_INVALID_ARGUMENT, Message("n_times is ", view(*times).size(), "; the file has ", n, " point arrays ",
                                        prefix, "_*")
                                    .text());
  Frames frames;
  frames.times = times ? *times : times_in_file(path, data, prefix, n);
  frames.faces = faces_of(path, data, leaflets.name, leaflets.is_required);
  check_places(path, frames.faces.xyz, "");
  for (const Displacement &displacement : displacements) add_displaced(path, frames, displacement);
  return frames;
}

}  // namespace riis::vtk
