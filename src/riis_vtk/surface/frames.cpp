// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/surface/surfaces.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include <vtkCellTypes.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkPointData.h>

#include "common/array_view.hpp"
#include "riis_vtk/read/other_files.hpp"

namespace riis::vtk {
namespace {

// The cells of the first file, which are compared with the cells of the other files. Faces cannot be compared, because they
// depend on the positions of the vertices, which differ between the files.
class FirstCells {
 public:
  explicit FirstCells(vtkPointSet *data) : n_points_(data->GetNumberOfPoints()) {
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell_id = 0; cell_id < data->GetNumberOfCells(); ++cell_id) {
      data->GetCellPoints(cell_id, ids);
      types_.push_back(data->GetCellType(cell_id));
      ids_.insert(ids_.end(), ids->begin(), ids->end());
      ends_.push_back(ids_.size());
    }
  }

  // Fails if another file does not have the same cells.
  void compare(const std::string &path, vtkPointSet *data) const {
    compare_numbers(path, "points", data->GetNumberOfPoints(), n_points_);
    compare_numbers(path, "cells", data->GetNumberOfCells(), view(types_).size());
    vtkNew<vtkIdList> ids;
    std::size_t begin = 0;
    for (std::size_t cell = 0; cell < types_.size(); begin = ends_[cell++]) {
      data->GetCellPoints(static_cast<vtkIdType>(cell), ids);
      const int type = data->GetCellType(static_cast<vtkIdType>(cell));
      const auto n = static_cast<vtkIdType>(ends_[cell] - begin);
      if (type != types_[cell] || ids->GetNumberOfIds() != n)
        fail_file(path, "cell ", cell, " is a ", name_of(type), " with ", ids->GetNumberOfIds(),
                  " points; in the first file it is a ", name_of(types_[cell]), " with ", n);
      for (vtkIdType k = 0; k < n; ++k)
        if (ids->GetId(k) != ids_[begin + static_cast<std::size_t>(k)])
          fail_file(path, "corner ", k, " of cell ", cell, " is point ", ids->GetId(k),
                    "; in the first file it is point ", ids_[begin + static_cast<std::size_t>(k)]);
    }
  }

 private:
  static const char *name_of(int type) { return vtkCellTypes::GetClassNameFromTypeId(type); }
  static void compare_numbers(const std::string &path, const char *what, std::int64_t n, std::int64_t n_first) {
    if (n != n_first)
      fail_file(path, "has ", n, " ", what, ", the first file ", n_first,
                "; all files of a motion have the same points and cells");
  }

  vtkIdType n_points_;
  std::vector<int> types_;
  std::vector<vtkIdType> ids_;
  std::vector<std::size_t> ends_;  // the end of each cell in ids_
};

// The corners of triangles in a file whose triangles share no vertices, such as an .stl file. Corners that are at one position in
// the first file become one vertex.
class MergedCorners {
 public:
  // Merges vertices of the faces. Vertices are numbered in the order of their first corners.
  explicit MergedCorners(Faces &faces) {
    const std::vector<std::int64_t> places = places_of(faces);
    std::vector<std::int64_t> vertex_at(places.size(), -1);
    std::vector<double> xyz;
    for (std::size_t corner = 0; corner < places.size(); ++corner) {
      std::int64_t &vertex = view(vertex_at)[places[corner]];
      if (vertex < 0) {
        vertex = view(corner_of_).size();
        corner_of_.push_back(corner);
        xyz.insert(xyz.end(), &faces.xyz[3 * corner], &faces.xyz[3 * corner] + 3);
      }
      vertex_of_.push_back(static_cast<std::size_t>(vertex));
    }
    for (std::int64_t &id : faces.vertex_ids) id = view(vertex_at)[view(places)[id]];
    faces.xyz = std::move(xyz);
  }

  // Returns the positions of the vertices. The positions of all corners are given. Fails if two corners of a vertex have
  // different positions.
  std::vector<double> merged(const std::string &path, const std::vector<double> &corners) const {
    for (std::size_t corner = 0; corner < vertex_of_.size(); ++corner) {
      const std::size_t first = corner_of_[vertex_of_[corner]];
      const double *a = &corners[3 * first], *b = &corners[3 * corner];
      if (a[0] == b[0] && a[1] == b[1] && a[2] == b[2]) continue;
      fail_file(path, "corner ", first % 3, " of triangle ", first / 3, " is at ", a[0], " ", a[1], " ", a[2],
                ", corner ", corner % 3, " of triangle ", corner / 3, " at ", b[0], " ", b[1], " ", b[2],
                "; in the first file they are at one place: are the triangles in another order?");
    }
    std::vector<double> xyz;
    for (const std::size_t corner : corner_of_) xyz.insert(xyz.end(), &corners[3 * corner], &corners[3 * corner] + 3);
    return xyz;
  }

 private:
  std::vector<std::size_t> vertex_of_;  // for each corner, its vertex
  std::vector<std::size_t> corner_of_;  // for each vertex, its first corner
};

struct Displacement {
  std::int64_t number;
  std::string name;
  vtkDataArray *array;  // owned by the data set
};

// Returns the number in a name such as PREFIX_12 or PREFIX12. Returns -1 for a name of another form.
std::int64_t number_in(const std::string &name, const std::string &prefix) {
  if (name.rfind(prefix, 0) != 0) return -1;
  const std::size_t begin = prefix.size() + (name.size() > prefix.size() && name[prefix.size()] == '_' ? 1 : 0);
  std::int64_t number = -1;
  return read_number(std::string_view(name).substr(begin), number) && name[begin] != '-' ? number : -1;
}

vtkDataArray *displacements_in(const std::string &path, vtkAbstractArray *abstract, const std::string &name) {
  vtkDataArray *array = vtkDataArray::SafeDownCast(abstract);
  if (!array) fail_file(path, "point array ", name, " holds no numbers");
  if (array->GetNumberOfComponents() != 3)
    fail_file(path, "point array ", name, " has ", array->GetNumberOfComponents(), " components; displacements have 3");
  return array;
}

// Returns the arrays in the order of their numbers. Fails if two arrays have the same number.
std::vector<Displacement> displacements_of(const std::string &path, vtkPointSet *data, const std::string &prefix) {
  std::vector<Displacement> found;
  for (int i = 0; i < data->GetPointData()->GetNumberOfArrays(); ++i) {
    vtkAbstractArray *abstract = data->GetPointData()->GetAbstractArray(i);
    const std::string name = abstract->GetName() ? abstract->GetName() : "";
    const std::int64_t number = number_in(name, prefix);
    if (number >= 0) found.push_back({number, name, displacements_in(path, abstract, name)});
  }
  if (found.empty())
    fail_file(path, "has no point array ", prefix, "_0, ", prefix, "_1, ...", list_of_arrays(data->GetPointData()));
  std::sort(found.begin(), found.end(), [](const auto &a, const auto &b) { return a.number < b.number; });
  for (std::size_t i = 1; i < found.size(); ++i)
    if (found[i].number == found[i - 1].number)
      fail_file(path, "has the point arrays ", found[i - 1].name, " and ", found[i].name, " with the same number");
  return found;
}

std::vector<double> times_in_file(const std::string &path, vtkPointSet *data, const std::string &prefix,
                                  std::int64_t n) {
  vtkAbstractArray *abstract = data->GetFieldData()->GetAbstractArray(time_array);
  if (!abstract)
    fail_file(path, "has no field array ", time_array, ", and no times are given",
              list_of_arrays(data->GetFieldData()));
  vtkDataArray *array = vtkDataArray::SafeDownCast(abstract);
  if (!array || array->GetNumberOfValues() != n)
    fail_file(path, "field array ", time_array, " has ", array ? array->GetNumberOfValues() : 0, " numbers, for ", n,
              " point arrays ", prefix, "_*");
  std::vector<double> times;
  const int n_components = array->GetNumberOfComponents();
  for (vtkIdType i = 0; i < n; ++i)
    times.push_back(array->GetComponent(i / n_components, static_cast<int>(i % n_components)));
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!is_time(times[i]))
      fail_file(path, "value ", i, " of field array ", time_array, " is ", times[i],
                "; it must be finite and at most 1e30 in magnitude");
    if (i > 0 && !(times[i] > times[i - 1]))
      fail_file(path, "value ", i, " of field array ", time_array, " is ", times[i],
                ", which is not above the value before it, ", times[i - 1]);
  }
  return times;
}

// Fails if the core would refuse a coordinate. In the message, `after` follows the number of the point.
void check_places(const std::string &path, const std::vector<double> &xyz, const std::string &after) {
  constexpr double largest = 1e60;  // the limit in riis.h
  constexpr std::array<const char *, 3> axes{"x", "y", "z"};
  for (std::size_t i = 0; i < xyz.size(); ++i)
    if (!(std::abs(xyz[i]) <= largest))
      fail_file(path, axes[i % 3], " of point ", i / 3, after, " is ", xyz[i], "; it must be finite and at most ",
                largest, " in magnitude");
}

// Appends a frame. frames.times must already have the times of all frames.
void add_frame(Frames &frames, const std::vector<double> &xyz) {
  // The memory for all frames is reserved at once. An array that grows by doubling may need twice as much memory.
  if (frames.xyz.empty()) frames.xyz.reserve(xyz.size() * frames.times.size());
  frames.xyz.insert(frames.xyz.end(), xyz.begin(), xyz.end());
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

// Returns the file that has the faces for svMultiPhysics's frames.
std::string face_file_of(const std::string &path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const std::string stem = std::filesystem::path(path).stem().string();
  std::string name = stem;
  while (!name.empty()) {
    for (const char *more : {"", "_mesh", "_face"})
      for (const char *ending : {".vtu", ".vtp"}) {
        const std::filesystem::path file = folder / (name + more + ending);
        std::error_code error;
        if (std::filesystem::is_regular_file(file, error)) return file.string();
      }
    const std::size_t end = name.rfind('_');
    name.resize(end == std::string::npos ? 0 : end);
  }
  fail_file(path, "has frames of nodes; no file beside it has their faces: ", stem.substr(0, stem.find('_')),
            ".vtu is missing");
}

}  // namespace

Frames frames_of_files(const std::vector<std::string> &paths, std::vector<double> times, const LeafletArray &leaflets,
                       const CaughtOutput &caught) {
  Frames frames;
  frames.times = std::move(times);
  const vtkSmartPointer<vtkPointSet> first = read_surface_data(paths[0], caught);
  const FirstCells cells(first);
  frames.faces = faces_of(paths[0], first, leaflets);
  check_places(paths[0], frames.faces.xyz, "");
  std::optional<MergedCorners> corners;
  if (ending_of(paths[0]) == "stl") corners.emplace(frames.faces);
  add_frame(frames, frames.faces.xyz);
  for (std::size_t i = 1; i < paths.size(); ++i) {
    const vtkSmartPointer<vtkPointSet> data = read_surface_data(paths[i], caught);
    cells.compare(paths[i], data);
    const std::vector<double> xyz = coordinates_of(data);
    check_places(paths[i], xyz, "");
    add_frame(frames, corners ? corners->merged(paths[i], xyz) : xyz);
  }
  return frames;
}

Frames frames_of_text(const std::string &path, double time_step, const LeafletArray &leaflets,
                      const CaughtOutput &caught) {
  const MappedFile file(path, check_readable(path));
  Source in(path, file.bytes());
  const std::int64_t n_frames = in.integer(8), n_nodes = in.integer(8);
  if (n_frames < 1 || n_frames > most_frames)
    in.refuse("there are ", n_frames, " frames; 1 to ", most_frames, " are read");
  constexpr int least_bytes = 5;  // three numbers take at least this many
  in.check_count(n_nodes, least_bytes * n_frames, "nodes in each frame");
  const std::string face_path = face_file_of(path);
  const vtkSmartPointer<vtkPointSet> data = read_surface_data(face_path, caught);
  if (data->GetNumberOfPoints() != n_nodes)
    fail_file(path, "has ", n_nodes, " nodes; ", face_path, ", which has their faces, has ", data->GetNumberOfPoints());
  Frames frames;
  frames.faces = faces_of(face_path, data, leaflets);
  for (std::int64_t i = 0; i < n_frames; ++i) frames.times.push_back(static_cast<double>(i) * time_step);
  std::vector<double> xyz(static_cast<std::size_t>(3 * n_nodes));
  for (std::int64_t i = 0; i < n_frames; ++i) {
    for (double &x : xyz) x = in.real(8);
    check_places(path, xyz, " of frame " + std::to_string(i));
    if (i == 0) frames.faces.xyz = xyz;
    add_frame(frames, xyz);
  }
  if (!in.word().empty()) in.refuse("the file holds more than ", n_frames, " frames of ", n_nodes, " nodes");
  return frames;
}

void append_frames(Frames &frames, const Frames &other) {
  const std::int64_t n = view(frames.times).size();
  if (view(other.times).size() != n)
    refuse_argument("the motions have ", n, " and ", view(other.times).size(),
                    " frames; all motions need the same times");
  for (std::int64_t i = 0; i < n; ++i)
    if (view(frames.times)[i] != view(other.times)[i])
      refuse_argument("frame ", i, " is at the time ", view(frames.times)[i], " in one motion and at ",
                      view(other.times)[i], " in the other; all motions need the same times");
  const std::vector<double> &first = frames.xyz, &second = other.xyz;
  const auto n_first = view(first).size() / n, n_second = view(second).size() / n;
  std::vector<double> xyz;
  xyz.reserve(first.size() + second.size());
  for (std::int64_t i = 0; i < n; ++i) {
    xyz.insert(xyz.end(), first.begin() + i * n_first, first.begin() + (i + 1) * n_first);
    xyz.insert(xyz.end(), second.begin() + i * n_second, second.begin() + (i + 1) * n_second);
  }
  append_faces(frames.faces, other.faces);
  frames.xyz = std::move(xyz);
}

Frames frames_of_displacements(const std::string &path, const std::string &prefix, const std::vector<double> *times,
                               const LeafletArray &leaflets, const CaughtOutput &caught) {
  const std::string ending = ending_of(path);
  if (ending != "vtp" && ending != "vtu") fail_file(path, "displacements must be in a .vtp or .vtu file");
  const vtkSmartPointer<vtkPointSet> data = read_surface_data(path, caught);
  const std::vector<Displacement> displacements = displacements_of(path, data, prefix);
  const std::int64_t n = view(displacements).size();
  if (times && view(*times).size() != n)
    refuse_argument("n_times is ", view(*times).size(), "; the file has ", n, " point arrays ", prefix, "_*");
  Frames frames;
  frames.times = times ? *times : times_in_file(path, data, prefix, n);
  frames.faces = faces_of(path, data, leaflets);
  check_places(path, frames.faces.xyz, "");
  for (const Displacement &displacement : displacements) add_displaced(path, frames, displacement);
  return frames;
}

}  // namespace riis::vtk
