// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/picture/picture_scene.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCleanPolyData.h>
#include <vtkDataArray.h>
#include <vtkFeatureEdges.h>
#include <vtkIdList.h>
#include <vtkLightKit.h>
#include <vtkMath.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "riis_vtk/base/files.hpp"
#include "riis_vtk/mesh/mesh.hpp"
#include "riis_vtk/mesh/outside_faces.hpp"
#include "riis_vtk/picture/drawing.hpp"

namespace riis::vtk {
namespace {

constexpr double pale = 0.62;  // the share of white in the colour of partly marked cells

enum MarkedPart : std::uint8_t { not_marked, partly_marked, whole_marked };

vtkSmartPointer<vtkRenderer> empty_panel() {
  const vtkSmartPointer<vtkRenderer> renderer = two_sided_renderer();
  vtkNew<vtkLightKit> lights;
  lights->AddLightsToRenderer(renderer);
  return renderer;
}

vtkSmartPointer<vtkActor> flat_actor(vtkPolyData *data, const Colour &colour) {
  const vtkSmartPointer<vtkActor> actor = actor_of(data);
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  actor->GetProperty()->LightingOff();
  return actor;
}

// Gives every face the colour of its leaflet, mixed with white. `white` is the share of white in the colour.
void colour_faces(vtkPolyData *faces, const std::vector<vtkIdType> &leaflets, double white) {
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName("colour");
  colours->SetNumberOfComponents(3);
  for (const vtkIdType leaflet : leaflets) {
    const Colour colour = colour_of_leaflet(leaflet);
    for (const double part : colour) {
      colours->InsertNextValue(static_cast<unsigned char>(255 * (part + white * (1 - part)) + 0.5));
    }
  }
  faces->GetCellData()->SetScalars(colours);
}

vtkSmartPointer<vtkActor> coloured_actor(vtkPolyData *faces) {
  const vtkSmartPointer<vtkActor> actor = coloured_actor_of(faces);
  // Without ambient light, parts that face away from the lamps would lose their colour.
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetDiffuse(0.85);
  actor->GetProperty()->SetSpecular(0.15);
  actor->GetProperty()->SetSpecularPower(20);
  return actor;
}

std::vector<std::uint8_t> marked_nodes(vtkUnstructuredGrid *grid) {
  vtkDataArray *marked = grid->GetPointData()->GetArray(marked_array);
  std::vector<std::uint8_t> nodes(static_cast<std::size_t>(grid->GetNumberOfPoints()));
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    nodes[node] = marked->GetComponent(static_cast<vtkIdType>(node), 0) != 0;
  }
  return nodes;
}

// Returns for each cell of the grid whether the cell is wholly marked, partly marked or not marked. Cells whose dimension is
// below the largest in the grid count as not marked.
std::vector<std::uint8_t> marked_parts(vtkUnstructuredGrid *grid, const std::vector<std::uint8_t> &marked) {
  const int dimension = largest_dimension(grid);
  std::vector<std::uint8_t> parts(static_cast<std::size_t>(grid->GetNumberOfCells()), not_marked);
  for (std::size_t at = 0; at < parts.size(); ++at) {
    const auto cell = static_cast<vtkIdType>(at);
    if (shape_of(grid->GetCellType(cell)).dimension != dimension) continue;
    vtkIdType n = 0;
    const vtkIdType *nodes = nullptr;
    grid->GetCells()->GetCellAtId(cell, n, nodes);
    const auto n_marked =
        std::count_if(nodes, nodes + n, [&](vtkIdType node) { return marked[static_cast<std::size_t>(node)] != 0; });
    if (n_marked > 0) parts[at] = n_marked == n ? whole_marked : partly_marked;
  }
  return parts;
}

// For each cell, returns the leaflet of the closest marked node.
std::vector<vtkIdType> leaflets_of(vtkUnstructuredGrid *grid, const std::vector<vtkIdType> &cells) {
  vtkDataArray *distance = grid->GetPointData()->GetArray(distance_array);
  vtkDataArray *leaflet = grid->GetPointData()->GetArray(leaflet_array);
  vtkDataArray *marked = grid->GetPointData()->GetArray(marked_array);
  std::vector<vtkIdType> leaflets;
  leaflets.reserve(cells.size());
  vtkNew<vtkIdList> nodes;
  for (const vtkIdType cell : cells) {
    grid->GetCellPoints(cell, nodes);
    vtkIdType closest = -1;
    for (const vtkIdType node : *nodes) {
      // Only marked nodes are compared. The distance of an unmarked node may be the far distance, which can have any value.
      if (marked->GetComponent(node, 0) == 0) continue;
      if (closest < 0 || distance->GetComponent(node, 0) < distance->GetComponent(closest, 0)) closest = node;
    }
    leaflets.push_back(closest < 0 ? 0 : static_cast<vtkIdType>(leaflet->GetComponent(closest, 0)));
  }
  return leaflets;
}

// Returns the mean length of the faces' first edges.
double mean_edge_length(vtkPolyData *faces) {
  double sum = 0;
  vtkNew<vtkIdList> corners;
  for (vtkIdType face = 0; face < faces->GetNumberOfCells(); ++face) {
    faces->GetCellPoints(face, corners);
    double a[3], b[3];
    faces->GetPoint(corners->GetId(0), a);
    faces->GetPoint(corners->GetId(1), b);
    sum += std::sqrt(vtkMath::Distance2BetweenPoints(a, b));
  }
  return sum / std::max(1.0, static_cast<double>(faces->GetNumberOfCells()));
}

// Moves an actor away from the eye. Without perspective, the actor looks the same, but nearer parts can then hide it.
void move_away(vtkActor *actor, const View &view, double length) {
  actor->SetPosition(length * view.away()[0], length * view.away()[1], length * view.away()[2]);
}

}  // namespace

Colour colour_of_leaflet(vtkIdType leaflet) {
  const unsigned char *bytes = distinct_colours[static_cast<std::size_t>(leaflet) % std::size(distinct_colours)];
  return {bytes[0] / 255.0, bytes[1] / 255.0, bytes[2] / 255.0};
}

SurfacePanel::SurfacePanel(double pixels) : renderer_(empty_panel()), pixels_(pixels) {}

void SurfacePanel::show(vtkPolyData *surface) {
  leaflets_.clear();
  vtkDataArray *leaflet = surface->GetCellData()->GetArray(leaflet_array);
  std::vector<vtkIdType> leaflets;
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i) {
    leaflets.push_back(static_cast<vtkIdType>(leaflet->GetComponent(i, 0)));
    leaflets_.insert(leaflets.back());
  }
  colour_faces(surface, leaflets, 0);
  for (vtkActor *actor : {leaflets_drawn_.Get(), rims_.Get()}) renderer_->RemoveActor(actor);
  leaflets_drawn_ = coloured_actor(smoothed(surface));
  renderer_->AddActor(leaflets_drawn_);
  // Vertices at one position are joined first, because the patches of a leaflet do not share the vertices of their common sides.
  vtkNew<vtkCleanPolyData> joined;
  joined->SetInputData(surface);
  joined->SetTolerance(0);
  joined->ConvertPolysToLinesOff();
  vtkNew<vtkFeatureEdges> rims;
  rims->SetInputConnection(joined->GetOutputPort());
  rims->FeatureEdgesOff();
  rims->ManifoldEdgesOff();
  rims->ColoringOff();
  rims->Update();
  rims_ = coloured_actor_of(rims->GetOutput());
  rims_->GetProperty()->LightingOff();
  rims_->GetProperty()->SetLineWidth(static_cast<float>(2 * pixels_));
  renderer_->AddActor(rims_);
}

void SurfacePanel::look(const View &view, const Sight &sight) {
  constexpr double behind = 0.01;  // distance of the lines behind the faces, in half heights of the panel
  move_away(rims_, view, behind * sight.shown[1].half());
}

MarksPanel::MarksPanel(double pixels) : renderer_(empty_panel()), pixels_(pixels) {}

void MarksPanel::show(vtkUnstructuredGrid *grid, std::int64_t n_leaking_edges, const std::int64_t *leaking_edges) {
  for (vtkActor *actor : {partly_.Get(), whole_.Get(), leaks_.Get()}) renderer_->RemoveActor(actor);
  leaks_ = nullptr;
  add_marks(grid);
  add_leaks(grid, n_leaking_edges, leaking_edges);
}

void MarksPanel::add_marks(vtkUnstructuredGrid *grid) {
  const std::vector<std::uint8_t> marked = marked_nodes(grid);
  std::vector<std::uint8_t> parts = marked_parts(grid, marked);
  counts_ = {grid->GetNumberOfPoints(), std::count(marked.begin(), marked.end(), 1),
             std::count(parts.begin(), parts.end(), whole_marked),
             std::count(parts.begin(), parts.end(), partly_marked)};
  // Faces between wholly marked cells and partly marked cells are left out, because nobody can see them. Partly marked cells
  // surround the wholly marked cells.
  std::vector<std::uint8_t> chosen(parts.size());
  std::transform(parts.begin(), parts.end(), chosen.begin(), [](std::uint8_t part) { return part == partly_marked; });
  const Outside partly = outside_of(grid, &parts, &chosen);
  colour_faces(partly.faces, leaflets_of(grid, partly.cell_id), pale);
  partly_length_ = mean_edge_length(partly.faces);
  partly_ = coloured_actor(partly.faces);
  // Faces that look towards the eye are not drawn, because they would hide the wholly marked cells. Faces that look away from the
  // eye are visible around the wholly marked cells, and in gaps between them.
  partly_->GetProperty()->SetFrontfaceCulling(partly.of_volumes);
  partly_->GetProperty()->SetAmbient(0.6);
  partly_->GetProperty()->SetDiffuse(0.45);
  renderer_->AddActor(partly_);
  std::transform(parts.begin(), parts.end(), chosen.begin(), [](std::uint8_t part) { return part == whole_marked; });
  const Outside whole = outside_of(grid, &chosen, nullptr);
  colour_faces(whole.faces, leaflets_of(grid, whole.cell_id), 0);
  whole_ = coloured_actor(whole.faces);
  renderer_->AddActor(whole_);
}

void MarksPanel::add_leaks(vtkUnstructuredGrid *grid, std::int64_t n, const std::int64_t *edges) {
  if (n == 0) return;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines, dots;
  for (std::int64_t i = 0; i < n; ++i) {
    double a[3], b[3];
    grid->GetPoint(edges[2 * i], a);
    grid->GetPoint(edges[2 * i + 1], b);
    const double middle[3] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
    const vtkIdType ends[2] = {points->InsertNextPoint(a), points->InsertNextPoint(b)};
    const vtkIdType dot = points->InsertNextPoint(middle);
    lines->InsertNextCell(2, ends);
    dots->InsertNextCell(1, &dot);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  data->SetVerts(dots);  // dots show edges that point at the eye or are shorter than a pixel
  leaks_ = flat_actor(data, leak_colour);
  leaks_->GetProperty()->SetLineWidth(static_cast<float>(2 * pixels_));
  leaks_->GetProperty()->SetPointSize(static_cast<float>(3 * pixels_));
  renderer_->AddActor(leaks_);
}

void MarksPanel::look(const View &view, const Sight &sight) {
  move_away(partly_, view, 2 * partly_length_);
  if (leaks_) move_away(leaks_, view, -2 * sight.shown[2].half());
}

}  // namespace riis::vtk
