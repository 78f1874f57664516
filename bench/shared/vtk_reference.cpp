// SPDX-License-Identifier: Apache-2.0
#include "vtk_reference.hpp"

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>
#include <vtkStaticPointLocator.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace bench {
namespace {

// Corners that triangles share become one point, because VTK's signed distance uses neighbouring triangles.
void fill(vtkPolyData *mesh, const Triangles &triangles) {
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const vtkNew<vtkCellArray> cells;
  std::map<std::array<double, 3>, vtkIdType> known;
  for (std::int64_t i = 0; i < triangles.n(); ++i) {
    vtkIdType ids[3];
    for (std::int64_t corner = 0; corner < 3; ++corner) {
      const double *p = triangles.corners.data() + 9 * i + 3 * corner;
      const auto [at, is_new] = known.try_emplace({p[0], p[1], p[2]}, points->GetNumberOfPoints());
      if (is_new) points->InsertNextPoint(p);
      ids[corner] = at->second;
    }
    cells->InsertNextCell(3, ids);
  }
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
}

}  // namespace

struct VtkLocator::Implementation {
  vtkNew<vtkPolyData> mesh;
  vtkNew<vtkStaticCellLocator> locator;
};

VtkLocator::VtkLocator(const Triangles &triangles) : implementation_(std::make_unique<Implementation>()) {
  fill(implementation_->mesh, triangles);
  implementation_->locator->SetDataSet(implementation_->mesh);
  implementation_->locator->BuildLocator();
}
VtkLocator::~VtkLocator() = default;

void VtkLocator::distances(std::int64_t n_nodes, const double *xyz, double limit, double *distance) const {
  const vtkNew<vtkGenericCell> cell;
  for (std::int64_t i = 0; i < n_nodes; ++i) {
    double p[3] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]}, closest[3], sq = 0;
    vtkIdType cell_id = -1;
    int sub_id = 0, inside = 0;
    const vtkIdType found =
        implementation_->locator->FindClosestPointWithinRadius(p, limit, closest, cell, cell_id, sub_id, sq, inside);
    distance[i] = found ? std::sqrt(sq) : std::numeric_limits<double>::infinity();
  }
}

struct VtkDistance::Implementation {
  vtkNew<vtkPolyData> mesh;
  vtkNew<vtkImplicitPolyDataDistance> distance;
};

VtkDistance::VtkDistance(const Triangles &triangles) : implementation_(std::make_unique<Implementation>()) {
  fill(implementation_->mesh, triangles);
  implementation_->distance->SetInput(implementation_->mesh);
}
VtkDistance::~VtkDistance() = default;

void VtkDistance::distances(std::int64_t n_nodes, const double *xyz, double *distance) const {
  for (std::int64_t i = 0; i < n_nodes; ++i) {
    double p[3] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
    distance[i] = std::abs(implementation_->distance->EvaluateFunction(p));
  }
}

struct VtkPoints::Implementation {
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkStaticPointLocator> locator;
};

VtkPoints::VtkPoints(const std::vector<double> &points) : implementation_(std::make_unique<Implementation>()) {
  const vtkNew<vtkPoints> all;
  all->SetDataTypeToDouble();
  for (std::size_t i = 0; i < points.size(); i += 3) all->InsertNextPoint(points.data() + i);
  implementation_->cloud->SetPoints(all);
  implementation_->locator->SetDataSet(implementation_->cloud);
  implementation_->locator->BuildLocator();
}
VtkPoints::~VtkPoints() = default;

void VtkPoints::distances(std::int64_t n_nodes, const double *xyz, double limit, double *distance) const {
  for (std::int64_t i = 0; i < n_nodes; ++i) {
    double squared = 0;
    const vtkIdType found = implementation_->locator->FindClosestPointWithinRadius(limit, xyz + 3 * i, squared);
    distance[i] = found >= 0 ? std::sqrt(squared) : std::numeric_limits<double>::infinity();
  }
}

}  // namespace bench
