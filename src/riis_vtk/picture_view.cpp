// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/picture_view.hpp"

#include <riis/riis_vtk.h>

#include <algorithm>
#include <limits>

#include <vtkCamera.h>
#include <vtkMath.h>
#include <vtkPointSet.h>

namespace riis::vtk {
namespace {

constexpr double not_much_larger = 1.6;
constexpr double margin = 1.08;        // the panel's size over the size of what it fits
constexpr double neighbourhood = 1.3;  // the shown size over the surface's, where the mesh goes on
constexpr double cut_at = 0.94;        // the cut's place, as a part of the way from the middle to the panel's edge

Extent hull(const Extent &a, const Extent &b) { return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)}; }

Extent around(const Extent &extent, double factor) {
  return {extent.middle() - factor * extent.half(), extent.middle() + factor * extent.half()};
}

// Returns the extent that must be in sight along one axis. size is the surface's size.
Extent wanted(const Extent &surface, const Extent &mesh, double size) {
  const Extent both = hull(surface, mesh);
  if (both.half() <= not_much_larger * size || !surface.meets(mesh)) return both;
  return around(surface, neighbourhood);
}

}  // namespace

View::View(std::int32_t view) {
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
}

namespace {

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

}  // namespace

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

Sight sight_of(const Extents &surface, const Extents *mesh, double aspect) {
  Extents seen = surface;
  if (mesh) {
    const double size = std::max(surface[0].half(), surface[1].half());
    for (std::size_t k = 0; k < 2; ++k) seen[k] = wanted(surface[k], (*mesh)[k], size);
    seen[2] = hull(surface[2], (*mesh)[2]);
  }
  const double half_height = margin * std::max(seen[1].half(), seen[0].half() / aspect);
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
  // The eye is outside everything, with room for parts that are drawn nearer than they are.
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

}  // namespace riis::vtk
