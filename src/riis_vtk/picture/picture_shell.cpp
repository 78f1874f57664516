// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/picture/picture_shell.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkDataArray.h>
#include <vtkFeatureEdges.h>
#include <vtkIdList.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include "common/array_view.hpp"
#include "riis_vtk/mesh/flat_ends.hpp"
#include "riis_vtk/picture/drawing.hpp"

namespace riis::vtk {
namespace {

constexpr double sharp_angle = 30;  // degrees between faces

// The opacity of a face of the shell that is seen head-on, and the opacity that is added at a grazing angle.
constexpr double opacity_across = 0.10, opacity_along = 0.36, grazing_power = 2.2;

vtkSmartPointer<vtkPolyData> joined_points(vtkPolyData *faces) {
  vtkNew<vtkCleanPolyData> joined;
  joined->SetInputData(faces);
  joined->SetTolerance(0);
  joined->ConvertPolysToLinesOff();
  joined->Update();
  return joined->GetOutput();
}

vtkSmartPointer<vtkPolyData> kept(vtkPolyData *faces, const std::vector<std::uint8_t> &is_left_out) {
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> corners;
  for (vtkIdType face = 0; face < faces->GetNumberOfCells(); ++face) {
    if (view(is_left_out)[face]) continue;
    faces->GetCellPoints(face, corners);
    polygons->InsertNextCell(corners);
  }
  const auto rest = vtkSmartPointer<vtkPolyData>::New();
  rest->SetPoints(faces->GetPoints());
  rest->SetPolys(polygons);
  return rest;
}

vtkSmartPointer<vtkPolyData> lines_of(vtkPolyData *faces, bool with_sharp_edges) {
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(faces);
  edges->SetFeatureAngle(sharp_angle);
  edges->SetFeatureEdges(with_sharp_edges);
  edges->NonManifoldEdgesOff();
  edges->ManifoldEdgesOff();
  edges->ColoringOff();
  edges->Update();
  return edges->GetOutput();
}

vtkSmartPointer<vtkActor> line_actor(vtkPolyData *lines, const Colour &colour, double pixels) {
  const vtkSmartPointer<vtkActor> actor = actor_of(lines);
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(static_cast<float>(pixels));
  return actor;
}

}  // namespace

Shell::Shell(vtkPolyData *faces, double grey, const Colour &line, double pixels, bool has_dashes)
    : grey_(static_cast<unsigned char>(255 * grey)), has_dashes_(has_dashes) {
  const vtkSmartPointer<vtkPolyData> joined = joined_points(faces);
  const FlatParts flat = flat_ends(joined);
  const vtkSmartPointer<vtkPolyData> wall = flat.are_all ? joined : kept(joined, flat.is_end);
  rims_ = line_actor(lines_of(wall, flat.are_all), line, pixels);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(wall);
  normals->SetSplitting(flat.are_all);
  normals->SetFeatureAngle(sharp_angle);
  normals->Update();
  faces_ = normals->GetOutput();
  skin_ = actor_of(faces_);
  skin_->GetMapper()->SetScalarModeToUsePointData();
  skin_->GetMapper()->SetColorModeToDirectScalars();
  skin_->ForceTranslucentOn();
  skin_->GetProperty()->SetAmbient(0.45);
  skin_->GetProperty()->SetDiffuse(0.6);
  skin_->GetProperty()->SetSpecular(0.25);
  skin_->GetProperty()->SetSpecularPower(25);
  vtkNew<vtkPolyData> nothing;
  cut_ = line_actor(nothing, line, pixels);
}

void Shell::add_to(vtkRenderer *renderer) const {
  for (vtkActor *actor : {skin_.Get(), rims_.Get(), cut_.Get()}) renderer->AddActor(actor);
}

// Sorts faces from far to near, because each face is blended with the faces that were drawn before it. Without perspective, the
// order and the opacity of the faces depend only on the direction of view.
void Shell::sort(const View &view_now) {
  if (sorted_for_ && sorted_for_->axes == view_now.axes) return;
  sorted_for_ = view_now;
  const double *away = view_now.away().data();
  vtkDataArray *normals = faces_->GetPointData()->GetNormals();
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(4);
  for (vtkIdType i = 0; i < faces_->GetNumberOfPoints(); ++i) {
    double normal[3];
    normals->GetTuple(i, normal);
    const double grazing = 1 - std::min(1.0, std::abs(vtkMath::Dot(normal, away)));
    const double opacity = opacity_across + opacity_along * std::pow(grazing, grazing_power);
    for (const unsigned char part : {grey_, grey_, grey_, static_cast<unsigned char>(255 * opacity + 0.5)})
      colours->InsertNextValue(part);
  }
  const vtkIdType n = faces_->GetNumberOfCells();
  std::vector<double> depths(static_cast<std::size_t>(n));
  std::vector<vtkIdType> order(depths.size());
  vtkNew<vtkIdList> corners;
  for (vtkIdType face = 0; face < n; ++face) {
    faces_->GetCellPoints(face, corners);
    for (const vtkIdType corner : *corners) {
      double point[3];
      faces_->GetPoint(corner, point);
      view(depths)[face] += vtkMath::Dot(point, away) / static_cast<double>(corners->GetNumberOfIds());
    }
  }
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](vtkIdType i, vtkIdType j) { return view(depths)[i] > view(depths)[j]; });
  vtkNew<vtkCellArray> sorted;
  for (const vtkIdType face : order) {
    faces_->GetCellPoints(face, corners);
    sorted->InsertNextCell(corners);
  }
  vtkNew<vtkPolyData> drawn;
  drawn->SetPoints(faces_->GetPoints());
  drawn->SetPolys(sorted);
  drawn->GetPointData()->SetNormals(normals);
  drawn->GetPointData()->SetScalars(colours);
  vtkPolyDataMapper::SafeDownCast(skin_->GetMapper())->SetInputData(drawn);
}

void Shell::look(const View &view, const Sight &sight) {
  sort(view);
  for (vtkActor *actor : {skin_.Get(), rims_.Get()}) {
    actor->GetMapper()->RemoveAllClippingPlanes();
    for (vtkPlane *plane : cutting_planes(view, sight)) actor->GetMapper()->AddClippingPlane(plane);
  }
  if (has_dashes_)
    vtkPolyDataMapper::SafeDownCast(cut_->GetMapper())->SetInputData(dashes_where_cut(view, sight, faces_));
}

}  // namespace riis::vtk
