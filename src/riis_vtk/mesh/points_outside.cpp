// SPDX-License-Identifier: Apache-2.0
// Finds the points that lie outside a mesh. First, the points inside each cell are found. For the remaining points, this file
// makes a surface from the faces of nearby cells. The core computes the distances of these points from the surface.
#include <riis/riis_vtk.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <vtkDoubleArray.h>
#include <vtkPoints.h>

#include "common/array_view.hpp"
#include "common/vectors.hpp"
#include "riis_vtk/base/files.hpp"
#include "riis_vtk/mesh/cell_polygons.hpp"
#include "riis_vtk/mesh/mesh.hpp"

namespace riis::vtk {
namespace {

// Returns six times the signed volume of a tetrahedron.
double volume_of(const Vector3 &a, const Vector3 &b, const Vector3 &c, const Vector3 &d) {
  return dot(b - a, cross(c - a, d - a));
}

// Returns whether p is inside the tetrahedron with the corners a, b, c and d. Up to rounding, points on the boundary count as
// inside.
bool contains(const Vector3 &a, const Vector3 &b, const Vector3 &c, const Vector3 &d, const Vector3 &p) {
  const double whole = volume_of(a, b, c, d), sign = whole < 0 ? -1 : 1, least = -1e-9 * std::fabs(whole);
  return whole != 0 && sign * volume_of(p, b, c, d) >= least && sign * volume_of(a, p, c, d) >= least &&
         sign * volume_of(a, b, p, d) >= least && sign * volume_of(a, b, c, p) >= least;
}

struct CellBounds {
  Vector3 lower = {INFINITY, INFINITY, INFINITY}, upper = {-INFINITY, -INFINITY, -INFINITY};

  void grow(const Vector3 &p) {
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], p[k]);
      upper[k] = std::max(upper[k], p[k]);
    }
  }
  bool has(const Vector3 &p) const {
    return p[0] >= lower[0] && p[0] <= upper[0] && p[1] >= lower[1] && p[1] <= upper[1] && p[2] >= lower[2] &&
           p[2] <= upper[2];
  }
};

// Sorts points into the boxes of a regular grid. Boxes that are neighbours along z follow each other in the list, and so do their
// points.
class PointGrid {
 public:
  explicit PointGrid(std::vector<Vector3> points) : points_(std::move(points)) {
    constexpr double most_boxes = 64;  // along an axis
    for (const Vector3 &p : points_) bounds_.grow(p);
    const Vector3 sides = bounds_.upper - bounds_.lower;
    const double largest = std::max({sides[0], sides[1], sides[2]});
    for (std::size_t k = 0; k < 3; ++k) {
      n_[k] = largest > 0 ? 1 + static_cast<std::int64_t>(most_boxes * (sides[k] / largest)) : 1;
      per_length_[k] = sides[k] > 0 ? static_cast<double>(n_[k]) / sides[k] : 0;
    }
    starts_.resize(static_cast<std::size_t>(n_[0] * n_[1] * n_[2]) + 1);
    for (const Vector3 &p : points_) ++view(starts_)[box_of(p) + 1];
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    order_.resize(points_.size());
    std::vector<std::int64_t> next = starts_;
    for (std::size_t i = 0; i < points_.size(); ++i)
      view(order_)[view(next)[box_of(points_[i])]++] = static_cast<std::int64_t>(i);
  }

  const Vector3 &point(std::int64_t i) const { return view(points_)[i]; }

  // Calls `visit` with the number of each point within the given bounds.
  template <class Visit>
  void for_each_in(const CellBounds &wanted, const Visit &visit) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (!(wanted.lower[k] <= bounds_.upper[k] && wanted.upper[k] >= bounds_.lower[k])) return;
    for (std::int64_t i = place(wanted.lower, 0); i <= place(wanted.upper, 0); ++i)
      for (std::int64_t j = place(wanted.lower, 1); j <= place(wanted.upper, 1); ++j) {
        const std::int64_t row = (i * n_[1] + j) * n_[2];
        const std::int64_t end = view(starts_)[row + place(wanted.upper, 2) + 1];
        for (std::int64_t at = view(starts_)[row + place(wanted.lower, 2)]; at < end; ++at)
          if (wanted.has(point(view(order_)[at]))) visit(view(order_)[at]);
      }
  }

 private:
  std::int64_t place(const Vector3 &p, std::size_t k) const {
    const double at = std::max(0.0, (p[k] - bounds_.lower[k]) * per_length_[k]);
    return std::min(static_cast<std::int64_t>(std::min(at, 1e6)), n_[k] - 1);
  }
  std::int64_t box_of(const Vector3 &p) const { return (place(p, 0) * n_[1] + place(p, 1)) * n_[2] + place(p, 2); }

  std::vector<Vector3> points_;
  CellBounds bounds_;
  std::array<std::int64_t, 3> n_ = {};
  Vector3 per_length_ = {};
  std::vector<std::int64_t> starts_, order_;
};

// Cuts the volume cells of a mesh into tetrahedra, and their faces into triangles. The cell's middle is a corner of all its
// tetrahedra. If a face has more than three corners, the face's middle is a corner of all its triangles. Two neighbouring cells
// therefore cut their common face in the same way.
class SolidCells {
 public:
  explicit SolidCells(vtkUnstructuredGrid *grid)
      : grid_(grid), xyz_(vtkDoubleArray::SafeDownCast(grid->GetPoints()->GetData())->GetPointer(0)), polygons_(grid) {}

  // Calls `visit` with each volume cell and its bounds.
  template <class Visit>
  void for_each(const Visit &visit) {
    for (vtkIdType cell = 0; cell < grid_->GetNumberOfCells(); ++cell) {
      if (shape_of(grid_->GetCellType(cell)).dimension != 3) continue;
      vtkIdType n = 0;
      const vtkIdType *ids = nullptr;
      grid_->GetCells()->GetCellAtId(cell, n, ids);
      CellBounds bounds;
      for (vtkIdType i = 0; i < n; ++i) bounds.grow(point(ids[i]));
      visit(cell, bounds);
    }
  }

  // Calls visit(a, b, c) once for each triangle of each face.
  template <class Visit>
  void for_each_triangle(vtkIdType cell, const Visit &visit) {
    const int n_faces = polygons_.n_faces_of_volume(cell);
    for (int face = 0; face < n_faces; ++face) {
      const Corners &corners = polygons_.face_of_volume(cell, face);
      if (corners.size() == 3) visit(point(corners[0]), point(corners[1]), point(corners[2]));
      if (corners.size() <= 3) continue;
      const Vector3 middle = mean_of(corners.data(), view(corners).size());
      for (std::size_t i = 0; i < corners.size(); ++i)
        visit(point(corners[i]), point(corners[(i + 1) % corners.size()]), middle);
    }
  }

  bool has(vtkIdType cell, const Vector3 &p) {
    vtkIdType n = 0;
    const vtkIdType *ids = nullptr;
    grid_->GetCells()->GetCellAtId(cell, n, ids);
    if (grid_->GetCellType(cell) == VTK_TETRA)
      return contains(point(ids[0]), point(ids[1]), point(ids[2]), point(ids[3]), p);
    const Vector3 middle = mean_of(ids, n);
    bool is_in = false;
    for_each_triangle(cell, [&](const Vector3 &a, const Vector3 &b, const Vector3 &c) {
      is_in = is_in || contains(middle, a, b, c, p);
    });
    return is_in;
  }

 private:
  Vector3 point(vtkIdType id) const { return {xyz_[3 * id], xyz_[3 * id + 1], xyz_[3 * id + 2]}; }
  Vector3 mean_of(const vtkIdType *ids, std::int64_t n) const {
    Vector3 sum = {0, 0, 0};
    for (std::int64_t i = 0; i < n; ++i) sum = sum + point(ids[i]);
    return 1.0 / static_cast<double>(n) * sum;
  }

  vtkUnstructuredGrid *grid_;
  const double *xyz_;
  CellPolygons polygons_;
};

struct SurfaceDeleter {
  void operator()(riis_surface *surface) const { riis_surface_destroy(&surface); }
};

// Returns the distances of points from triangles. Each triangle is given by three corners.
std::vector<double> distances_from(const std::vector<Vector3> &triangles, const std::vector<Vector3> &points) {
  std::vector<std::int64_t> corners(triangles.size());
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::int64_t>(i);
  riis_surface_arrays arrays;
  check_core(riis_surface_arrays_init(&arrays, sizeof arrays));
  arrays.n_vertices = view(triangles).size();
  arrays.x = triangles[0].data();
  arrays.y = triangles[0].data() + 1;
  arrays.z = triangles[0].data() + 2;
  arrays.stride = 3;
  arrays.n_faces = view(triangles).size() / 3;
  arrays.vertex_ids = corners.data();
  arrays.id_bits = 64;
  riis_surface_options options;
  check_core(riis_surface_options_init(&options, sizeof options));
  options.zero_area = RIIS_ZERO_AREA_SKIP;
  riis_surface *made = nullptr;
  check_core(riis_surface_create_from_arrays(&arrays, &options, &made));
  const std::unique_ptr<riis_surface, SurfaceDeleter> surface(made);
  riis_points asked;
  check_core(riis_points_init(&asked, sizeof asked));
  asked.n_points = view(points).size();
  asked.x = points[0].data();
  asked.y = points[0].data() + 1;
  asked.z = points[0].data() + 2;
  asked.stride = 3;
  std::vector<double> distances(points.size());
  riis_closest_arrays to;
  check_core(riis_closest_arrays_init(&to, sizeof to));
  to.distance = distances.data();
  check_core(riis_closest_points(surface.get(), &asked, nullptr, &to));
  return distances;
}

// The points that are still outside, and their numbers in the caller's list.
struct Asked {
  Asked(std::int64_t n_points, const double *xyz, const std::uint8_t *is_outside) {
    for (std::int64_t i = 0; i < n_points; ++i) {
      if (is_outside[i] == 0) continue;
      number.push_back(i);
      points.push_back({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
    }
  }
  std::vector<std::int64_t> number;
  std::vector<Vector3> points;
};

void find_contained(SolidCells &cells, const Asked &asked, std::uint8_t *is_outside) {
  const PointGrid grid(asked.points);
  cells.for_each([&](vtkIdType cell, const CellBounds &bounds) {
    grid.for_each_in(bounds, [&](std::int64_t i) {
      std::uint8_t &out = is_outside[view(asked.number)[i]];
      if (out != 0 && cells.has(cell, grid.point(i))) out = 0;
    });
  });
}

void find_near(SolidCells &cells, const Asked &asked, double distance, std::uint8_t *is_outside) {
  const PointGrid grid(asked.points);
  std::vector<Vector3> triangles;
  cells.for_each([&](vtkIdType cell, CellBounds bounds) {
    for (std::size_t k = 0; k < 3; ++k) {
      bounds.lower[k] -= distance;
      bounds.upper[k] += distance;
    }
    bool is_near = false;
    grid.for_each_in(bounds, [&](std::int64_t) { is_near = true; });
    if (!is_near) return;
    cells.for_each_triangle(cell, [&](const Vector3 &a, const Vector3 &b, const Vector3 &c) {
      const Vector3 normal = cross(b - a, c - a);
      if (dot(normal, normal) > 0) triangles.insert(triangles.end(), {a, b, c});
    });
  });
  if (triangles.empty()) return;
  const std::vector<double> distances = distances_from(triangles, asked.points);
  for (std::size_t i = 0; i < distances.size(); ++i)
    if (distances[i] <= distance) is_outside[asked.number[i]] = 0;
}

}  // namespace
}  // namespace riis::vtk

using namespace riis::vtk;

extern "C" {

RIIS_API riis_status riis_vtk_mesh_find_outside(const riis_vtk_mesh *mesh, int64_t n_points, const double *xyz,
                                                double distance, uint8_t *is_outside) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    if (n_points < 0) refuse_argument("n_points is ", n_points);
    if (!(distance >= 0 && std::isfinite(distance)))
      refuse_argument("distance is ", distance, "; it must be finite and at least 0");
    if (n_points == 0) return;
    require(xyz, "xyz");
    require(is_outside, "is_outside");
    for (int64_t i = 0; i < 3 * n_points; ++i)
      if (!std::isfinite(xyz[i])) refuse_argument("xyz[", i, "] is ", xyz[i]);
    if (mesh->axes) return find_outside(*mesh->axes, n_points, xyz, distance, is_outside);
    SolidCells cells(mesh->grid());
    find_contained(cells, Asked(n_points, xyz, is_outside), is_outside);
    const Asked left(n_points, xyz, is_outside);
    if (!left.points.empty()) find_near(cells, left, distance, is_outside);
  });
}

}  // extern "C"
