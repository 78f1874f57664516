// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/mesh/flat_ends.hpp"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>

#include "common/flat_parts.hpp"

namespace riis::vtk {
namespace {

constexpr double least_rest = 0.1;  // least area without the flat ends, as a share of the wall's area

}  // namespace

FlatParts flat_ends(vtkPolyData *faces) {
  // In a file, the corners of a face may run clockwise or counter-clockwise. The filter gives neighbouring faces the same
  // orientation, but all faces may then face inwards.
  vtkNew<vtkPolyDataNormals> alike;
  alike->SetInputData(faces);
  alike->SplittingOff();
  alike->Update();
  vtkPolyData *const turned = alike->GetOutput();
  Triangles triangles;
  std::vector<vtkIdType> face_of;
  resize(triangles.points, turned->GetNumberOfPoints());
  for (vtkIdType i = 0; i < turned->GetNumberOfPoints(); ++i) turned->GetPoint(i, view(triangles.points)[i].data());
  vtkNew<vtkIdList> corners;
  for (vtkIdType face = 0; face < turned->GetNumberOfCells(); ++face) {
    turned->GetCellPoints(face, corners);
    for (vtkIdType k = 2; k < corners->GetNumberOfIds(); ++k) {
      triangles.corners.push_back({corners->GetId(0), corners->GetId(k - 1), corners->GetId(k)});
      face_of.push_back(face);
    }
  }
  FlatParts ends{std::vector<std::uint8_t>(static_cast<std::size_t>(faces->GetNumberOfCells())), false};
  if (face_of.empty()) return ends;
  flat_parts::Finder finder(triangles, false);
  double of_ends = 0;
  for (const flat_parts::Part &part : finder.find({})) {
    if (!part.is_large || !part.is_sharp()) continue;
    of_ends += part.area;
    for (const std::int64_t i : part.triangles) view(ends.is_end)[view(face_of)[i]] = 1;
  }
  ends.are_all = of_ends > (1 - least_rest) * finder.whole_area();
  return ends;
}

}  // namespace riis::vtk
