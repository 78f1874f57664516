// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include <vtkCellData.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkThreshold.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "riis_vtk/mesh/flat_ends.hpp"
#include "riis_vtk/mesh/outside_faces.hpp"
#include "vtk_shim.h"

namespace {

using Point = std::array<double, 3>;
using Polygon = std::vector<Point>;

Polygon polygon_of(vtkPolyData *faces, vtkIdType face) {
  vtkNew<vtkIdList> corners;
  faces->GetCellPoints(face, corners);
  Polygon polygon;
  for (const vtkIdType corner : *corners) {
    Point point;
    faces->GetPoint(corner, point.data());
    polygon.push_back(point);
  }
  return polygon;
}

// Sorts corners and polygons, so that the results of riis and of VTK have the same order.
std::vector<Polygon> sorted(std::vector<Polygon> polygons) {
  for (Polygon &polygon : polygons) std::sort(polygon.begin(), polygon.end());
  std::sort(polygons.begin(), polygons.end());
  return polygons;
}

vtkSmartPointer<vtkUnstructuredGrid> volumes_of(vtkUnstructuredGrid *grid) {
  vtkNew<vtkUnstructuredGrid> marked;
  marked->CopyStructure(grid);
  vtkNew<vtkIntArray> dimensions;
  dimensions->SetName("dimension");
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    dimensions->InsertNextValue(grid->GetCell(cell)->GetCellDimension());
  }
  marked->GetCellData()->AddArray(dimensions);
  vtkNew<vtkThreshold> threshold;
  threshold->SetInputData(marked);
  threshold->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "dimension");
  threshold->SetThresholdFunction(vtkThreshold::THRESHOLD_UPPER);
  threshold->SetUpperThreshold(3);
  threshold->Update();
  return threshold->GetOutput();
}

std::vector<Polygon> outside_by_vtk(vtkUnstructuredGrid *grid) {
  vtkNew<vtkDataSetSurfaceFilter> filter;
  filter->SetInputData(volumes_of(grid));
  filter->SetNonlinearSubdivisionLevel(0);
  filter->Update();
  std::vector<Polygon> polygons;
  for (vtkIdType face = 0; face < filter->GetOutput()->GetNumberOfCells(); ++face) {
    polygons.push_back(polygon_of(filter->GetOutput(), face));
  }
  return polygons;
}

// Returns whether the middle of the cell lies in front of the face. Seen from the front, the face's corners run anticlockwise.
bool looks_inwards(const Polygon &face, vtkCell *cell) {
  double normal[3] = {0, 0, 0}, middle[3] = {0, 0, 0}, to_middle[3];
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    double a[3], b[3], part[3];
    vtkMath::Subtract(face[i].data(), face[0].data(), a);
    vtkMath::Subtract(face[i + 1].data(), face[0].data(), b);
    vtkMath::Cross(a, b, part);
    vtkMath::Add(normal, part, normal);
  }
  const vtkIdType n = cell->GetNumberOfPoints();
  for (vtkIdType i = 0; i < n; ++i) vtkMath::Add(middle, cell->GetPoints()->GetPoint(i), middle);
  vtkMath::MultiplyScalar(middle, 1.0 / static_cast<double>(n));
  vtkMath::Subtract(middle, face[0].data(), to_middle);
  return vtkMath::Dot(to_middle, normal) > 1e-9;
}

}  // namespace

int64_t shim_compare_outside(const char *path, int64_t *n_faces, int64_t *n_inwards) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (!reader->CanReadFile(path)) return -1;
  reader->SetFileName(path);
  reader->Update();
  vtkUnstructuredGrid *grid = reader->GetOutput();
  const riis::vtk::Outside outside = riis::vtk::outside_of(grid, nullptr, nullptr);
  std::vector<Polygon> ours;
  *n_inwards = 0;
  for (vtkIdType face = 0; face < outside.faces->GetNumberOfCells(); ++face) {
    ours.push_back(polygon_of(outside.faces, face));
    *n_inwards += looks_inwards(ours.back(), grid->GetCell(outside.cell_id[static_cast<std::size_t>(face)]));
  }
  *n_faces = static_cast<int64_t>(ours.size());
  const std::vector<Polygon> a = sorted(ours), b = sorted(outside_by_vtk(grid));
  std::vector<Polygon> different;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(different));
  return static_cast<int64_t>(different.size());
}

int shim_flat_ends(int64_t n_points, const double *xyz, int64_t n_triangles, const int64_t *corners,
                   unsigned char *is_end) {
  const riis::vtk::FlatParts parts = riis::vtk::flat_ends(shim_polydata(n_points, xyz, n_triangles, corners));
  std::copy(parts.is_end.begin(), parts.is_end.end(), is_end);
  return parts.are_all;
}
