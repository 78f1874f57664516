// SPDX-License-Identifier: Apache-2.0
// The input is a .vti, .vtr or .vts file, or a legacy file with a structured grid. The results are axes and arrays, or an
// unstructured grid if the nodes do not lie on ascending axes.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include "riis_vtk/base/vtk_errors.hpp"

namespace riis::vtk {

// The axes of a rectilinear grid. Each axis has at least two coordinates, which are finite and ascend. Nodes and cells are in
// VTK's order, in which the first index changes fastest.
struct GridAxes {
  // The description of an image, whose axes are origin + i * spacing. i begins at `first`.
  struct Image {
    std::array<double, 3> origin, spacing;
    std::array<int, 3> first;
  };
  std::array<std::vector<double>, 3> of;
  std::optional<Image> image = {};

  std::int64_t size(std::size_t axis) const { return static_cast<std::int64_t>(of[axis].size()); }
  std::int64_t n_nodes() const { return size(0) * size(1) * size(2); }
  std::int64_t n_cells() const { return (size(0) - 1) * (size(1) - 1) * (size(2) - 1); }
};

// Adds the cells of a structured grid, which has n nodes along each axis, to a grid of points.
void add_structured_cells(vtkUnstructuredGrid *grid, const std::array<std::int64_t, 3> &n);

// Gives a data set all arrays of another data set: the arrays of its points and cells, and its field arrays.
void share_arrays(vtkDataSet *from, vtkDataSet *to);

// Returns whether the file has a structured grid. Looks at the file's ending, and in a legacy file at the header.
bool is_structured(const std::string &path);

struct StructuredFile {
  vtkSmartPointer<vtkUnstructuredGrid> data;  // with axes, the grid has only arrays
  std::unique_ptr<const GridAxes> axes;
};
StructuredFile read_structured(const std::string &path, const CaughtOutput &caught);

}  // namespace riis::vtk
