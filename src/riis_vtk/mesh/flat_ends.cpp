// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/mesh/flat_ends.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include <vtkIdList.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include "common/array_view.hpp"

namespace riis::vtk {
namespace {

using Normal = std::array<double, 3>;

constexpr double sharp_angle = 30;     // degrees between an end and the rest of the wall
constexpr double one_plane_angle = 1;  // degrees between the faces of an end
constexpr double one_plane_depth =
    1e-3;  // how far a point of an end may be from its plane, as a share of the wall's size
constexpr double least_sharp_part = 0.75;  // of the length of an end's rim
constexpr double least_area = 1e-4;        // of an end, as a share of the wall
constexpr vtkIdType least_faces = 3;       // of an end
constexpr double least_rest = 0.1;         // of the wall's area, without its flat ends

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
      Normal normal = {0, 0, 0};
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
    std::sort(edges.begin(), edges.end(),
              [](const Edge &e, const Edge &f) { return std::tie(e.a, e.b, e.face) < std::tie(f.a, f.b, f.face); });
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

  const Normal &normal(vtkIdType face) const { return view(normals_)[face]; }
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
  std::vector<Normal> normals_;
  std::vector<double> areas_;
  std::vector<std::vector<Neighbour>> neighbours_;
};

double cosine_of(double degrees) { return std::cos(vtkMath::RadiansFromDegrees(degrees)); }

// A plane through a face.
class Plane {
 public:
  Plane(vtkPolyData *faces, vtkIdType face, const Normal &normal) : faces_(faces), normal_(normal) {
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
  Normal normal_;
  vtkNew<vtkIdList> corners_;
  double at_ = 0;
};

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

}  // namespace riis::vtk
