// SPDX-License-Identifier: Apache-2.0
// Centres of cells, and pairs of cells that share a face, for solvers whose unknowns are at the centres of cells. The centres are
// those of OpenFOAM (primitiveMeshFaceCentresAndAreas.C, primitiveMeshCellCentresAndVols.C). A face is cut into triangles whose
// common corner is the mean of the face's nodes. A cell is cut into pyramids whose common apex is the mean of its faces' centres.
// If a cell is not star-shaped, some of its pyramids have negative volumes in OpenFOAM. This file takes the volumes of all
// pyramids as positive.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include <vtkCell.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include "common/array_view.hpp"
#include "common/vectors.hpp"
#include "riis_vtk/base/files.hpp"
#include "riis_vtk/mesh/mesh.hpp"

namespace riis::vtk {
namespace {

struct FaceCenter {
  Vector3 center, area;
};

FaceCenter center_of(vtkCell *face) {
  const vtkIdType n = face->GetNumberOfPoints();
  std::vector<Vector3> points(static_cast<std::size_t>(n));
  Vector3 mean = {0, 0, 0};
  for (vtkIdType i = 0; i < n; ++i) {
    face->GetPoints()->GetPoint(i, view(points)[i].data());
    mean = mean + view(points)[i];
  }
  mean = 1.0 / static_cast<double>(n) * mean;
  if (face->GetCellType() == VTK_PIXEL) std::swap(points[2], points[3]);  // the corners of a pixel do not go around it
  if (n == 3) return {mean, 0.5 * cross(points[1] - points[0], points[2] - points[0])};
  Vector3 area = {0, 0, 0}, moment = {0, 0, 0};
  double size = 0;
  for (vtkIdType i = 0; i < n; ++i) {
    const Vector3 &p = view(points)[i], &next = view(points)[(i + 1) % n];
    const Vector3 normal = cross(next - p, mean - p);
    const double length = std::sqrt(dot(normal, normal));
    area = area + normal;
    size += length;
    moment = moment + length * (p + next + mean);
  }
  return {size > 0 ? 1.0 / (3 * size) * moment : mean, 0.5 * area};
}

Vector3 center_of_cell(vtkCell *cell) {
  const int n = cell->GetNumberOfFaces();
  std::vector<FaceCenter> faces;
  Vector3 mean = {0, 0, 0}, moment = {0, 0, 0};
  for (int i = 0; i < n; ++i) {
    faces.push_back(center_of(cell->GetFace(i)));
    mean = mean + faces.back().center;
  }
  mean = 1.0 / n * mean;
  double volume = 0;
  for (const FaceCenter &face : faces) {
    const double pyramid = std::fabs(dot(face.area, face.center - mean));
    volume += pyramid;
    moment = moment + pyramid * (0.75 * face.center + 0.25 * mean);
  }
  return volume > 0 ? 1 / volume * moment : mean;
}

// A face, which is given by its nodes, and a cell to which the face belongs. Two different faces may have three nodes in common
// if these three nodes lie on one edge. Faces are therefore also compared by the number of their other nodes, and by a hash of
// these nodes.
struct FaceOfCell {
  std::array<vtkIdType, 3> smallest;
  std::uint64_t others;
  std::int64_t cell;

  bool is_face_of(const FaceOfCell &other) const { return smallest == other.smallest && others == other.others; }
  bool operator<(const FaceOfCell &other) const {
    return std::tie(smallest, others, cell) < std::tie(other.smallest, other.others, other.cell);
  }
};

FaceOfCell face_of(vtkCell *face, std::int64_t cell) {
  vtkIdList *const ids = face->GetPointIds();
  std::vector<vtkIdType> nodes(ids->begin(), ids->end());
  std::sort(nodes.begin(), nodes.end());
  std::uint64_t others = nodes.size();
  for (std::size_t i = 3; i < nodes.size(); ++i) {
    others = (others ^ static_cast<std::uint64_t>(nodes[i])) * 0x9e3779b97f4a7c15u;
    others ^= others >> 32;
  }
  return {{nodes[0], nodes[1], nodes[2]}, others, cell};
}

}  // namespace

CellCenters centers_of(vtkUnstructuredGrid *grid) {
  CellCenters centers;
  const vtkIdType n_cells = grid->GetNumberOfCells();
  if (n_cells == 0) refuse_argument("mesh has no cells, so it has no centres of cells");
  std::vector<FaceOfCell> faces;
  vtkNew<vtkGenericCell> cell;
  for (vtkIdType i = 0; i < n_cells; ++i) {
    grid->GetCell(i, cell);
    if (cell->GetCellDimension() != 3 || !cell->IsLinear() || cell->GetNumberOfFaces() < 4)
      refuse_argument("cell ", i, " is a ", vtkCellTypes::GetClassNameFromTypeId(grid->GetCellType(i)),
                      "; centres are those of linear volume cells and polyhedra");
    const Vector3 center = center_of_cell(cell);
    centers.xyz.insert(centers.xyz.end(), center.begin(), center.end());
    for (int face = 0; face < cell->GetNumberOfFaces(); ++face) faces.push_back(face_of(cell->GetFace(face), i));
  }
  std::sort(faces.begin(), faces.end());
  for (std::size_t i = 1; i < faces.size(); ++i)
    if (faces[i - 1].is_face_of(faces[i]) && faces[i - 1].cell != faces[i].cell)
      centers.pairs.insert(centers.pairs.end(), {faces[i - 1].cell, faces[i].cell});
  return centers;
}

}  // namespace riis::vtk
