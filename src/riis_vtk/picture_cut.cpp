// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/picture_cut.hpp"

#include <algorithm>

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace riis::vtk {
namespace {

// One side of the panel: a place along an axis, and the direction of the part that stays.
struct Side {
  std::size_t axis;
  double at;
  double inwards;  // 1 or -1
};

std::vector<Side> cut_sides(const Sight &sight) {
  std::vector<Side> sides;
  for (std::size_t k = 0; k < 2; ++k) {
    if (sight.cut_below[k]) sides.push_back({k, sight.uncut[k].lower, 1});
    if (sight.cut_above[k]) sides.push_back({k, sight.uncut[k].upper, -1});
  }
  return sides;
}

// Returns the stretches of the side's line that lie inside the boundary, sorted and disjoint.
std::vector<Extent> crossings(const View &view, const Side &side, vtkPolyData *boundary) {
  std::vector<Extent> all;
  const Vector &across = view.axes[side.axis], &along = view.axes[1 - side.axis];
  vtkNew<vtkIdList> corners;
  for (vtkIdType face = 0; face < boundary->GetNumberOfCells(); ++face) {
    boundary->GetCellPoints(face, corners);
    const vtkIdType n = corners->GetNumberOfIds();
    Extent crossed{0, 0};
    int n_crossed = 0;
    for (vtkIdType i = 0; i < n; ++i) {
      double a[3], b[3];
      boundary->GetPoint(corners->GetId(i), a);
      boundary->GetPoint(corners->GetId((i + 1) % n), b);
      const double ta = vtkMath::Dot(a, across.data()) - side.at, tb = vtkMath::Dot(b, across.data()) - side.at;
      if ((ta < 0) == (tb < 0)) continue;
      const double part = ta / (ta - tb);
      const double s = (1 - part) * vtkMath::Dot(a, along.data()) + part * vtkMath::Dot(b, along.data());
      crossed = n_crossed++ ? Extent{std::min(crossed.lower, s), std::max(crossed.upper, s)} : Extent{s, s};
    }
    if (n_crossed > 1) all.push_back(crossed);
  }
  std::sort(all.begin(), all.end(), [](const Extent &a, const Extent &b) { return a.lower < b.lower; });
  std::vector<Extent> apart;
  for (const Extent &next : all) {
    if (apart.empty() || next.lower > apart.back().upper) {
      apart.push_back(next);
    } else {
      apart.back().upper = std::max(apart.back().upper, next.upper);
    }
  }
  return apart;
}

class Dashes {
 public:
  Dashes(const View &view, const Sight &sight) : view_(view), sight_(sight), length_(0.025 * sight.shown[1].half()) {
    points_->SetDataTypeToDouble();
  }

  void add(const Side &side, const Extent &crossed) {
    const Extent &seen = sight_.uncut[1 - side.axis];
    const double end = std::min(crossed.upper, seen.upper);
    for (double s = std::max(crossed.lower, seen.lower); s < end; s += 2 * length_) {
      const vtkIdType ends[2] = {point(side, s), point(side, std::min(s + length_, end))};
      lines_->InsertNextCell(2, ends);
    }
  }

  vtkSmartPointer<vtkPolyData> lines() const {
    const auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points_);
    data->SetLines(lines_);
    return data;
  }

 private:
  vtkIdType point(const Side &side, double s) {
    Vector along_axes;
    along_axes[side.axis] = side.at;
    along_axes[1 - side.axis] = s;
    along_axes[2] = sight_.shown[2].lower;
    Vector at = {0, 0, 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t k = 0; k < 3; ++k) at[k] += along_axes[axis] * view_.axes[axis][k];
    }
    return points_->InsertNextPoint(at.data());
  }

  const View &view_;
  const Sight &sight_;
  double length_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> lines_;
};

}  // namespace

std::vector<vtkSmartPointer<vtkPlane>> cutting_planes(const View &view, const Sight &sight) {
  std::vector<vtkSmartPointer<vtkPlane>> planes;
  for (const Side &side : cut_sides(sight)) {
    const Vector &axis = view.axes[side.axis];
    const auto plane = vtkSmartPointer<vtkPlane>::New();
    plane->SetOrigin(side.at * axis[0], side.at * axis[1], side.at * axis[2]);
    plane->SetNormal(side.inwards * axis[0], side.inwards * axis[1], side.inwards * axis[2]);
    planes.push_back(plane);
  }
  return planes;
}

vtkSmartPointer<vtkPolyData> dashes_where_cut(const View &view, const Sight &sight, vtkPolyData *boundary) {
  Dashes dashes(view, sight);
  for (const Side &side : cut_sides(sight)) {
    for (const Extent &crossed : crossings(view, side, boundary)) dashes.add(side, crossed);
  }
  return dashes.lines();
}

}  // namespace riis::vtk
