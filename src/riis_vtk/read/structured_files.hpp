// SPDX-License-Identifier: Apache-2.0
// In: a .vti, .vtr or .vts file, or a legacy file of these kinds. Out: axes and arrays, or an unstructured grid if no ascending
// axes give the nodes.
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

// The axes of a rectilinear grid. Each axis has two or more coordinates, which are finite and ascend. Nodes and cells have VTK's
// order: the first index changes fastest.
struct GridAxes {
  // The form of an image. The image's axes are origin + i * spacing, with i from `first` on.
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

// Adds the cells of a structured grid with n nodes along each axis to the grid of its points. The cells are hexahedra, or quads,
// lines or a vertex for axes with one node.
void add_structured_cells(vtkUnstructuredGrid *grid, const std::array<std::int64_t, 3> &n);

// Lets a data set have the arrays of another one, on points, cells and the whole.
void share_arrays(vtkDataSet *from, vtkDataSet *to);

// Whether the ending, or the header of a legacy file, says that the file has a structured grid.
bool is_structured(const std::string &path);

struct StructuredFile {
  vtkSmartPointer<vtkUnstructuredGrid> data;  // with axes, the grid has only arrays
  std::unique_ptr<const GridAxes> axes;
};
StructuredFile read_structured(const std::string &path, const CaughtOutput &caught);

}  // namespace riis::vtk
