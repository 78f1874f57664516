// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/picture/picture_view.hpp"

#include <riis/riis_vtk.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include "common/vectors.hpp"

namespace riis::vtk {
namespace {

constexpr double not_much_larger = 1.6;
constexpr double margin = 1.08;        // the panel's size divided by the size of its content
constexpr double neighbourhood = 1.3;  // the visible size divided by the surface's size, if the mesh extends further
constexpr double cut_at = 0.94;  // the cut's position, as a share of the distance from the middle to the panel's edge

Extent hull(const Extent &a, const Extent &b) { return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)}; }

Extent around(const Extent &extent, double factor) {
  return {extent.middle() - factor * extent.half(), extent.middle() + factor * extent.half()};
}

// Returns the extent along one axis that must be visible. `size` is the surface's size.
Extent wanted(const Extent &surface, const Extent &mesh, double size, double reach) {
  const Extent both = hull(surface, mesh);
  if (both.half() <= not_much_larger * reach * size || !surface.meets(mesh)) return both;
  const Extent near = around(surface, neighbourhood * reach);
  return reach > 1 ? Extent{std::max(near.lower, both.lower), std::min(near.upper, both.upper)} : near;
}

Extents no_extents() {
  Extents extents;
  extents.fill({std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()});
  return extents;
}

void grow(Extents &extents, const View &view, const double point[3]) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double t = vtkMath::Dot(point, view.axes[k].data());
    extents[k] = hull(extents[k], {t, t});
  }
}

// A side of the panel at which the mesh is cut. The side is given by an axis, a position on the axis, and the direction towards
// the part that remains.
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

// Returns the parts of the side's line that lie inside the boundary. The parts are sorted, and do not overlap.
std::vector<Extent> cuts(const View &view, const Side &side, vtkPolyData *boundary) {
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

Axes axes_turned(const double axis[3], double degrees) {
  const Vector3 about = {axis[0], axis[1], axis[2]};
  return {turned({1, 0, 0}, about, degrees), turned({0, 1, 0}, about, degrees), turned({0, 0, 1}, about, degrees)};
}

Axes turned_about_z(const Axes &axes, double degrees) {
  const auto &[x, y, z] = axes;
  return {turned(x, z, degrees), turned(y, z, degrees), z};
}

View::View(std::int32_t view, const Axes &valve) {
  if (view == RIIS_VTK_VIEW_VALVE_LONG) view = RIIS_VTK_VIEW_VALVE_SIDE;
  const bool is_by_valve = view >= RIIS_VTK_VIEW_VALVE_SIDE;
  if (is_by_valve) view -= RIIS_VTK_VIEW_VALVE_SIDE;
  Vector up = {0, 0, 1}, away = {0.35, 0.55, -1.0};
  if (view == RIIS_VTK_VIEW_SIDE) away = {0, 1, 0};
  if (view == RIIS_VTK_VIEW_TOP) {
    away = {0, 0, -1};
    up = {0, 1, 0};
  }
  vtkMath::Normalize(away.data());
  const double along = vtkMath::Dot(up.data(), away.data());
  for (std::size_t k = 0; k < 3; ++k) up[k] -= along * away[k];
  vtkMath::Normalize(up.data());
  Vector right;
  vtkMath::Cross(away.data(), up.data(), right.data());
  axes = {right, up, away};
  if (!is_by_valve) return;
  for (Vector &direction : axes) {
    const Vector by_valve = direction;
    for (std::size_t i = 0; i < 3; ++i)
      direction[i] = by_valve[0] * valve[0][i] + by_valve[1] * valve[1][i] + by_valve[2] * valve[2][i];
  }
}

Extents View::extents_of(vtkPointSet *data) const {
  Extents extents = no_extents();
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    double point[3];
    data->GetPoint(i, point);
    grow(extents, *this, point);
  }
  return extents;
}

Extents View::extents_of(const Bounds &bounds) const {
  Extents extents = no_extents();
  for (const double x : {bounds[0].lower, bounds[0].upper}) {
    for (const double y : {bounds[1].lower, bounds[1].upper}) {
      for (const double z : {bounds[2].lower, bounds[2].upper}) {
        const double corner[3] = {x, y, z};
        grow(extents, *this, corner);
      }
    }
  }
  return extents;
}

Sight sight_of(const Extents &surface, const Extents *mesh, double aspect, double least, double reach) {
  Extents seen = surface;
  if (mesh) {
    const double size = std::max(surface[0].half(), surface[1].half());
    for (std::size_t k = 0; k < 2; ++k) seen[k] = wanted(surface[k], (*mesh)[k], size, reach);
    seen[2] = hull(surface[2], (*mesh)[2]);
  }
  const double half_height = std::max(least, margin * std::max(seen[1].half(), seen[0].half() / aspect));
  const std::array<double, 2> half = {half_height * aspect, half_height};
  Sight sight{seen, {}, {}, {}};
  for (std::size_t k = 0; k < 2; ++k) {
    const double middle = seen[k].middle();
    sight.shown[k] = {middle - half[k], middle + half[k]};
    sight.uncut[k] = sight.shown[k];
    sight.cut_below[k] = mesh && (*mesh)[k].lower < sight.shown[k].lower;
    if (sight.cut_below[k]) sight.uncut[k].lower = middle - cut_at * half[k];
    sight.cut_above[k] = mesh && (*mesh)[k].upper > sight.shown[k].upper;
    if (sight.cut_above[k]) sight.uncut[k].upper = middle + cut_at * half[k];
  }
  return sight;
}

void aim_camera(vtkCamera *camera, const View &view, const Sight &sight) {
  // The eye is outside of all objects. The depth leaves room for objects that are moved towards the eye for drawing.
  const double depth = 4 * (sight.shown[2].half() + sight.shown[1].half() + sight.shown[0].half());
  Vector focus, eye;
  for (std::size_t k = 0; k < 3; ++k) {
    focus[k] = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) focus[k] += sight.shown[axis].middle() * view.axes[axis][k];
    eye[k] = focus[k] - depth * view.away()[k];
  }
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(focus.data());
  camera->SetPosition(eye.data());
  camera->SetViewUp(view.up().data());
  camera->SetParallelScale(sight.shown[1].half());
}

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
    for (const Extent &crossed : cuts(view, side, boundary)) dashes.add(side, crossed);
  }
  return dashes.lines();
}

}  // namespace riis::vtk
