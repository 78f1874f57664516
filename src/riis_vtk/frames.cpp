// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/frames.hpp"

#include <array>
#include <optional>

#include <vtkCellTypes.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointSet.h>

#include "common/array_view.hpp"
#include "common/message.hpp"
#include "riis_vtk/files.hpp"
#include "riis_vtk/frame_checks.hpp"
#include "riis_vtk/pieces.hpp"
#include "riis_vtk/surface_data.hpp"

namespace riis::vtk {
namespace {

// The cells of the first file as they are there. Faces are made of them by places of vertices, which differ in other files.
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

  // Fails unless another file has the same cells.
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
        fail_file(path, Message("cell ", cell, " is a ", name_of(type), " with ", ids->GetNumberOfIds(),
                                " points; in the first file it is a ", name_of(types_[cell]), " with ", n)
                            .text());
      for (vtkIdType k = 0; k < n; ++k)
        if (ids->GetId(k) != ids_[begin + static_cast<std::size_t>(k)])
          fail_file(path, Message("corner ", k, " of cell ", cell, " is point ", ids->GetId(k),
                                  "; in the first file it is point ", ids_[begin + static_cast<std::size_t>(k)])
                              .text());
    }
  }

 private:
  static const char *name_of(int type) { return vtkCellTypes::GetClassNameFromTypeId(type); }
  static void compare_numbers(const std::string &path, const char *what, std::int64_t n, std::int64_t n_first) {
    if (n != n_first)
      fail_file(path, Message("has ", n, " ", what, ", the first file ", n_first,
                              "; all files of a motion have the same points and cells")
                          .text());
  }

  vtkIdType n_points_;
  std::vector<int> types_;
  std::vector<vtkIdType> ids_;
  std::vector<std::size_t> ends_;  // of each cell, in ids_
};

// The corners of triangles without vertices of their own, as in .stl files. Corners at one place in the first file are one vertex.
class MergedCorners {
 public:
  // Merges the vertices of the faces, which are numbered by their first corners.
  explicit MergedCorners(Faces &faces) {
    const std::vector<std::size_t> places = places_of(faces);
    std::vector<std::int64_t> vertex_at(places.size(), -1);
    std::vector<double> xyz;
    for (std::size_t corner = 0; corner < places.size(); ++corner) {
      std::int64_t &vertex = vertex_at[places[corner]];
      if (vertex < 0) {
        vertex = view(corner_of_).size();
        corner_of_.push_back(corner);
        xyz.insert(xyz.end(), &faces.xyz[3 * corner], &faces.xyz[3 * corner] + 3);
      }
      vertex_of_.push_back(static_cast<std::size_t>(vertex));
    }
    for (std::int64_t &id : faces.vertex_ids) id = vertex_at[places[static_cast<std::size_t>(id)]];
    faces.xyz = std::move(xyz);
  }

  // Returns the places of the vertices from those of all corners. Fails if corners of one vertex lie apart.
  std::vector<double> merged(const std::string &path, const std::vector<double> &corners) const {
    for (std::size_t corner = 0; corner < vertex_of_.size(); ++corner) {
      const std::size_t first = corner_of_[vertex_of_[corner]];
      const double *a = &corners[3 * first], *b = &corners[3 * corner];
      if (a[0] == b[0] && a[1] == b[1] && a[2] == b[2]) continue;
      fail_file(path, Message("corner ", first % 3, " of triangle ", first / 3, " is at ", a[0], " ", a[1], " ", a[2],
                              ", corner ", corner % 3, " of triangle ", corner / 3, " at ", b[0], " ", b[1], " ", b[2],
                              "; in the first file they are at one place: are the triangles in another order?")
                          .text());
    }
    std::vector<double> xyz;
    for (const std::size_t corner : corner_of_)
      xyz.insert(xyz.end(), &corners[3 * corner], &corners[3 * corner] + 3);
    return xyz;
  }

 private:
  std::vector<std::size_t> vertex_of_;  // of each corner
  std::vector<std::size_t> corner_of_;  // the first of each vertex
};

}  // namespace

void check_places(const std::string &path, const std::vector<double> &xyz, const std::string &after) {
  constexpr double largest = 1e60;  // as riis.h has it
  constexpr std::array<const char *, 3> axes{"x", "y", "z"};
  for (std::size_t i = 0; i < xyz.size(); ++i)
    if (!(std::abs(xyz[i]) <= largest))
      fail_file(path, Message(axes[i % 3], " of point ", i / 3, after, " is ", xyz[i],
                              "; it must be finite and at most ", largest, " in magnitude")
                          .text());
}

void add_frame(Frames &frames, const std::vector<double> &xyz) {
  // All at once: a doubled array would take twice its memory.
  if (frames.xyz.empty()) frames.xyz.reserve(xyz.size() * frames.times.size());
  frames.xyz.insert(frames.xyz.end(), xyz.begin(), xyz.end());
}

Frames frames_of_files(const std::vector<std::string> &paths, std::vector<double> times, const LeafletArray &leaflets,
                       const CaughtOutput &caught) {
  Frames frames;
  frames.times = std::move(times);
  const vtkSmartPointer<vtkPointSet> first = read_surface_data(paths[0], caught);
  const FirstCells cells(first);
  frames.faces = faces_of(paths[0], first, leaflets.name, leaflets.is_required);
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

}  // namespace riis::vtk
