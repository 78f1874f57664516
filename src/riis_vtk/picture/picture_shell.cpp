// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/picture/picture_shell.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
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
#include "riis_vtk/picture/drawing.hpp"

namespace riis::vtk {
namespace {

constexpr double sharp_angle = 30;        // degrees between an end and the rest of the wall
constexpr double one_plane_angle = 1;     // degrees between the faces of an end
constexpr double one_plane_depth = 1e-3;  // how far a point of an end may be from its plane, as a share of the wall's size
constexpr double least_sharp_part = 0.75;  // of the length of an end's rim
constexpr double least_area = 1e-4;        // of an end, as a share of the wall
constexpr vtkIdType least_faces = 3;       // of an end
constexpr double least_rest = 0.1;         // of the wall's area, without its flat ends

// The shell's opacity where it is seen at a right angle, and what a grazing angle adds.
constexpr double opacity_across = 0.10, opacity_along = 0.36, grazing_power = 2.2;
constexpr unsigned char shell_grey = 150;

// The normals and areas of faces, and the pairs of faces that share an edge.
class Surroundings {
 public:
  struct Edge {
    vtkIdType a, b, face;
    bool meets(const Edge &other) const { return a == other.a && b == other.b; }
  };
  struct Neighbour {
    vtkIdType face;
    double length;  // of the shared edge
  };

  explicit Surroundings(vtkPolyData *faces) {
    std::vector<Edge> edges;
    vtkNew<vtkIdList> corners;
    for (vtkIdType face = 0; face < faces->GetNumberOfCells(); ++face) {
      faces->GetCellPoints(face, corners);
      const vtkIdType n = corners->GetNumberOfIds();
      Vector normal = {0, 0, 0};
      double first[3], from[3], to[3], cross[3];
      faces->GetPoint(corners->GetId(0), first);
      for (vtkIdType i = 0; i < n; ++i) {
        const vtkIdType a = corners->GetId(i), b = corners->GetId((i + 1) % n);
        edges.push_back({std::min(a, b), std::max(a, b), face});
        faces->GetPoint(a, from);
        faces->GetPoint(b, to);
        for (int k = 0; k < 3; ++k) {
          from[k] -= first[k];
          to[k] -= first[k];
        }
        vtkMath::Cross(from, to, cross);
        for (std::size_t k = 0; k < 3; ++k) normal[k] += 0.5 * cross[k];
      }
      areas_.push_back(vtkMath::Normalize(normal.data()));
      normals_.push_back(normal);
    }
    std::sort(edges.begin(), edges.end(), [](const Edge &e, const Edge &f) {
      return std::pair(e.a, e.b) < std::pair(f.a, f.b);
    });
    neighbours_.resize(areas_.size());
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
      const Edge &e = edges[i], &f = edges[i + 1];
      if (!e.meets(f)) continue;
      double from[3], to[3];
      faces->GetPoint(e.a, from);
      faces->GetPoint(e.b, to);
      const double length = std::sqrt(vtkMath::Distance2BetweenPoints(from, to));
      view(neighbours_)[e.face].push_back({f.face, length});
      view(neighbours_)[f.face].push_back({e.face, length});
    }
  }

  const Vector &normal(vtkIdType face) const { return view(normals_)[face]; }
  double area(vtkIdType face) const { return view(areas_)[face]; }
  double whole_area() const { return std::accumulate(areas_.begin(), areas_.end(), 0.0); }
  const std::vector<Neighbour> &neighbours(vtkIdType face) const { return view(neighbours_)[face]; }
  // Returns the cosine of the angle between two faces, whatever their winding.
  double cosine(vtkIdType face, vtkIdType other) const {
    return std::abs(vtkMath::Dot(normal(face).data(), normal(other).data()));
  }
  // Returns the faces, the largest first.
  std::vector<vtkIdType> by_area() const {
    std::vector<vtkIdType> order(areas_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](vtkIdType i, vtkIdType j) { return area(i) > area(j); });
    return order;
  }

 private:
  std::vector<Vector> normals_;
  std::vector<double> areas_;
  std::vector<std::vector<Neighbour>> neighbours_;
};

double cosine_of(double degrees) { return std::cos(vtkMath::RadiansFromDegrees(degrees)); }

// A plane through a face.
class Plane {
 public:
  Plane(vtkPolyData *faces, vtkIdType face, const Vector &normal) : faces_(faces), normal_(normal) {
    double point[3];
    faces->GetCellPoints(face, corners_);
    faces->GetPoint(corners_->GetId(0), point);
    at_ = vtkMath::Dot(point, normal_.data());
  }
  double most_away(vtkIdType face) {
    double most = 0, point[3];
    faces_->GetCellPoints(face, corners_);
    for (const vtkIdType corner : *corners_) {
      faces_->GetPoint(corner, point);
      most = std::max(most, std::abs(vtkMath::Dot(point, normal_.data()) - at_));
    }
    return most;
  }

 private:
  vtkPolyData *faces_;
  Vector normal_;
  vtkNew<vtkIdList> corners_;
  double at_ = 0;
};

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

FlatParts flat_ends(vtkPolyData *faces) {
  const vtkIdType n = faces->GetNumberOfCells();
  const Surroundings around(faces);
  const double whole = around.whole_area(), depth = one_plane_depth * faces->GetLength();
  FlatParts parts{std::vector<std::uint8_t>(static_cast<std::size_t>(n)), false};
  std::vector<vtkIdType> part_of(static_cast<std::size_t>(n), -1);
  double of_ends = 0;
  for (const vtkIdType seed : around.by_area()) {
    if (view(part_of)[seed] >= 0) continue;
    Plane plane(faces, seed, around.normal(seed));
    std::vector<vtkIdType> part = {seed};
    view(part_of)[seed] = seed;
    double area = 0, sharp = 0, rim = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      area += around.area(part[i]);
      for (const Surroundings::Neighbour &next : around.neighbours(part[i])) {
        if (view(part_of)[next.face] >= 0) continue;
        if (around.cosine(seed, next.face) < cosine_of(one_plane_angle) || plane.most_away(next.face) > depth) continue;
        view(part_of)[next.face] = seed;
        part.push_back(next.face);
      }
    }
    for (const vtkIdType face : part)
      for (const Surroundings::Neighbour &next : around.neighbours(face)) {
        if (view(part_of)[next.face] == seed) continue;
        rim += next.length;
        if (around.cosine(face, next.face) < cosine_of(sharp_angle)) sharp += next.length;
      }
    const bool is_end = static_cast<vtkIdType>(part.size()) >= least_faces && area >= least_area * whole && rim > 0 &&
                        sharp >= least_sharp_part * rim;
    if (!is_end) continue;
    of_ends += area;
    for (const vtkIdType face : part) view(parts.is_end)[face] = 1;
  }
  parts.are_all = of_ends > (1 - least_rest) * whole;
  return parts;
}

Shell::Shell(vtkPolyData *faces, const Colour &line, double pixels) {
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

// Puts far faces first, because each face is blended with what is drawn before it. Without perspective, this order and the
// opacity depend only on the direction of view.
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
    for (const unsigned char part : {shell_grey, shell_grey, shell_grey, static_cast<unsigned char>(255 * opacity + 0.5)})
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
  vtkPolyDataMapper::SafeDownCast(cut_->GetMapper())->SetInputData(dashes_where_cut(view, sight, faces_));
}

}  // namespace riis::vtk
