// SPDX-License-Identifier: Apache-2.0
// Meshes whose nodes are given by the axes of a rectilinear grid. Points and cells of such a mesh are made only if a caller needs
// them.
#include <algorithm>
#include <cmath>
#include <utility>

#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>

#include "common/array_view.hpp"
#include "common/elementary.hpp"
#include "riis_vtk/base/files.hpp"
#include "riis_vtk/mesh/mesh.hpp"

namespace riis::vtk {

double median_edge_of(const GridAxes &axes) {
  const std::array<std::int64_t, 3> n = {axes.size(0) - 1, axes.size(1) - 1, axes.size(2) - 1};
  const std::int64_t n_cells = axes.n_cells(), n_asked = std::min(n_cells, most_measured);
  std::vector<double> lengths;
  for (std::int64_t i = 0; i < n_asked; ++i) {
    const std::int64_t cell = n_cells / n_asked * i + n_cells % n_asked * i / n_asked;
    const std::array<std::int64_t, 3> at = {cell % n[0], cell / n[0] % n[1], cell / n[0] / n[1]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double step = view(axes.of[axis])[at[axis] + 1] - view(axes.of[axis])[at[axis]];
      const double length = std::sqrt(step * step);
      // A cell has four edges along each axis. Only one of them is counted, because counting all four would not change the
      // median.
      if (length > 0 && std::isfinite(length)) lengths.push_back(length);
    }
  }
  return median_of(std::move(lengths));
}

riis_adjacency *adjacency_of(const GridAxes &axes, std::int32_t n_threads) {
  riis_adjacency *made = nullptr;
  check_core(riis_adjacency_create_from_grid(axes.size(0), axes.size(1), axes.size(2), n_threads, &made));
  return made;
}

void find_outside(const GridAxes &axes, std::int64_t n_points, const double *xyz, double distance,
                  std::uint8_t *is_outside) {
  for (std::int64_t i = 0; i < n_points; ++i) {
    double beyond[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = xyz[3 * i + static_cast<std::int64_t>(axis)];
      beyond[axis] = std::max({axes.of[axis].front() - x, x - axes.of[axis].back(), 0.0});
    }
    if (hypotenuse(beyond[0], beyond[1], beyond[2]) <= distance) is_outside[i] = 0;
  }
}

void write_axes(const std::string &path, const riis_vtk_mesh &mesh, const CaughtOutput &caught) {
  const std::string ending = ending_of(path);
  if (!mesh.axes || (ending == "vti" && !mesh.axes->image))
    fail_file(path, "takes a mesh that was read as ", ending == "vti" ? "an image" : "a rectilinear grid",
              ", with ascending axes; give a path that ends in .vtu");
  const GridAxes &axes = *mesh.axes;
  if (ending == "vti") {
    const GridAxes::Image &image = *axes.image;
    vtkNew<vtkImageData> made;
    int extent[6];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent[2 * axis] = image.first[axis];
      extent[2 * axis + 1] = image.first[axis] + static_cast<int>(axes.size(axis) - 1);
    }
    made->SetExtent(extent);
    made->SetOrigin(image.origin.data());
    made->SetSpacing(image.spacing.data());
    share_arrays(mesh.data, made);
    return write_xml<vtkXMLImageDataWriter>(path, ending, made, caught);
  }
  vtkNew<vtkRectilinearGrid> made;
  made->SetDimensions(static_cast<int>(axes.size(0)), static_cast<int>(axes.size(1)), static_cast<int>(axes.size(2)));
  const auto coordinates = [&](std::size_t axis) {
    const auto array = named_array<vtkDoubleArray>(std::string(1, "xyz"[axis]), axes.size(axis));
    std::copy(axes.of[axis].begin(), axes.of[axis].end(), array->GetPointer(0));
    return array;
  };
  made->SetXCoordinates(coordinates(0));
  made->SetYCoordinates(coordinates(1));
  made->SetZCoordinates(coordinates(2));
  share_arrays(mesh.data, made);
  write_xml<vtkXMLRectilinearGridWriter>(path, ending, made, caught);
}

}  // namespace riis::vtk

void riis_vtk_mesh::make_points() const {
  if (!axes || data->GetPoints()) return;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(axes->n_nodes());
  double *to = vtkDoubleArray::SafeDownCast(points->GetData())->GetPointer(0);
  for (const double z : axes->of[2])
    for (const double y : axes->of[1])
      for (const double x : axes->of[0])
        for (const double coordinate : {x, y, z}) *to++ = coordinate;
  data->SetPoints(points);
}

vtkUnstructuredGrid *riis_vtk_mesh::grid() const {
  if (axes && data->GetNumberOfCells() == 0) {
    make_points();
    riis::vtk::add_structured_cells(data, {axes->size(0), axes->size(1), axes->size(2)});
  }
  return data;
}
