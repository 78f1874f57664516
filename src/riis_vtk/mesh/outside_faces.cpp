// SPDX-License-Identifier: Apache-2.0
// Finds the outer faces of cells. VTK's filters for outer faces, vtkDataSetSurfaceFilter and vtkGeometryFilter, would take longer
// than all other steps of a picture.
#include "riis_vtk/mesh/outside_faces.hpp"

#include <algorithm>

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include "riis_vtk/mesh/cell_polygons.hpp"
#include "riis_vtk/mesh/mesh.hpp"

namespace riis::vtk {
namespace {

struct Face {
  vtkIdType cell;
  int number;  // the face's position in its cell
};

// Faces for which only one cell has been found so far. There are few lone faces at any time, because neighbouring cells are
// mostly near each other in the list of cells.
class LoneFaces {
 public:
  explicit LoneFaces(vtkIdType n_points) : first_(static_cast<std::size_t>(n_points), -1) {}

  // Adds a face. A face that is added for the second time belongs to two cells, and is removed.
  void toggle(const Corners &corners, Face face) {
    Key key = {-1, -1, -1, -1};
    std::partial_sort_copy(corners.begin(), corners.end(), key.begin(), key.end());
    std::int64_t &first = view(first_)[key[0]];
    std::int64_t *link = &first;
    while (*link >= 0) {
      Entry &entry = view(entries_)[*link];
      if (entry.key == key && entry.n_corners == corners.size()) {
        const std::int64_t freed = *link;
        *link = entry.next;
        entry.next = free_;
        free_ = freed;
        return;
      }
      link = &entry.next;
    }
    first = kept({key, corners.size(), first, face});
  }

  template <class Visit>
  void for_each(Visit &&visit) const {
    for (std::int64_t at : first_) {
      for (; at >= 0; at = view(entries_)[at].next) visit(view(entries_)[at].face);
    }
  }

 private:
  using Key = std::array<vtkIdType, 4>;  // the four lowest corners in ascending order; the last is -1 for a triangle

  struct Entry {
    Key key;
    std::size_t n_corners;
    std::int64_t next;
    Face face;
  };

  std::int64_t kept(const Entry &entry) {
    if (free_ >= 0) {
      const std::int64_t at = free_;
      free_ = view(entries_)[at].next;
      view(entries_)[at] = entry;
      return at;
    }
    entries_.push_back(entry);
    return view(entries_).size() - 1;
  }

  std::vector<std::int64_t> first_;  // for each node, the first of the faces whose lowest corner is this node
  std::vector<Entry> entries_;
  std::int64_t free_ = -1;
};

// Collects polygons and their points.
class Collected {
 public:
  explicit Collected(vtkUnstructuredGrid *grid)
      : from_(grid->GetPoints()), place_(static_cast<std::size_t>(grid->GetNumberOfPoints()), -1) {
    points_->SetDataTypeToDouble();
  }

  void add(const Corners &corners) {
    polygons_->InsertNextCell(static_cast<int>(corners.size()));
    for (const vtkIdType corner : corners) {
      vtkIdType &place = view(place_)[corner];
      if (place < 0) place = points_->InsertNextPoint(from_->GetPoint(corner));
      polygons_->InsertCellPoint(place);
    }
  }

  vtkSmartPointer<vtkPolyData> faces() const {
    const auto faces = vtkSmartPointer<vtkPolyData>::New();
    faces->SetPoints(points_);
    faces->SetPolys(polygons_);
    return faces;
  }

 private:
  vtkPoints *from_;
  std::vector<vtkIdType> place_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> polygons_;
};

// Reverses a face if its corners run clockwise, as seen from outside its cell. Inverted cells have such faces.
void turn_outwards(vtkUnstructuredGrid *grid, vtkIdType cell, Corners &corners) {
  vtkNew<vtkIdList> nodes;
  grid->GetCellPoints(cell, nodes);
  double inside[3] = {0, 0, 0};
  for (const vtkIdType node : *nodes) vtkMath::Add(inside, grid->GetPoint(node), inside);
  vtkMath::MultiplyScalar(inside, 1.0 / static_cast<double>(nodes->GetNumberOfIds()));
  // Adds up the volumes of the tetrahedra between a face and a point inside the cell.
  double first[3], volume = 0;
  vtkMath::Subtract(grid->GetPoint(corners[0]), inside, first);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    double a[3], b[3];
    vtkMath::Subtract(grid->GetPoint(corners[i]), inside, a);
    vtkMath::Subtract(grid->GetPoint(corners[i + 1]), inside, b);
    volume += vtkMath::Determinant3x3(first, a, b);
  }
  if (volume < 0) std::reverse(corners.begin(), corners.end());
}

bool is_wanted(const std::vector<std::uint8_t> *wanted, vtkIdType cell) { return !wanted || view(*wanted)[cell] != 0; }

}  // namespace

int largest_dimension(vtkUnstructuredGrid *grid) {
  int largest = 0;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
    largest = std::max(largest, shape_of(grid->GetCellType(i)).dimension);
  return largest;
}

Outside outside_of(vtkUnstructuredGrid *grid, const std::vector<std::uint8_t> *wanted,
                   const std::vector<std::uint8_t> *face_wanted) {
  const int dimension = largest_dimension(grid);
  CellPolygons polygons(grid);
  Collected collected(grid);
  Outside outside;
  const auto add = [&](vtkIdType cell, const Corners &corners) {
    if (corners.size() < 3 || !is_wanted(face_wanted, cell)) return;
    collected.add(corners);
    outside.cell_id.push_back(cell);
  };
  LoneFaces lone(grid->GetNumberOfPoints());
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    if (!is_wanted(wanted, cell) || shape_of(grid->GetCellType(cell)).dimension != dimension) continue;
    if (dimension == 2) add(cell, polygons.flat_cell(cell));
    if (dimension < 3) continue;
    const int n_faces = polygons.n_faces_of_volume(cell);
    for (int face = 0; face < n_faces; ++face) {
      const Corners &corners = polygons.face_of_volume(cell, face);
      if (corners.size() >= 3) lone.toggle(corners, {cell, face});
    }
  }
  lone.for_each([&](const Face &face) {
    if (!is_wanted(face_wanted, face.cell)) return;
    Corners corners = polygons.face_of_volume(face.cell, face.number);
    turn_outwards(grid, face.cell, corners);
    add(face.cell, corners);
  });
  outside.faces = collected.faces();
  outside.of_volumes = dimension == 3;
  return outside;
}

}  // namespace riis::vtk
