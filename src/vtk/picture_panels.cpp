// SPDX-License-Identifier: Apache-2.0
#include "vtk/picture_panels.hpp"

#include <array>
#include <set>
#include <string>

#include <vtkActor.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkFeatureEdges.h>
#include <vtkIdList.h>
#include <vtkLightKit.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkThreshold.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "vtk/array_names.hpp"

namespace riis::vtk {
namespace {

using Colour = std::array<unsigned char, 3>;

// Blue, orange, bluish green, reddish purple, vermilion, sky blue: told apart with any colour vision (Okabe, Ito 2008).
constexpr std::array<Colour, 6> leaflet_colours = {
    {{0, 114, 178}, {230, 159, 0}, {0, 158, 115}, {204, 121, 167}, {213, 94, 0}, {86, 180, 233}}};
constexpr double text_grey = 0.2;
constexpr double outline_grey = 0.45;

Colour colour_of(vtkIdType leaflet) {
  return leaflet_colours[static_cast<std::size_t>(leaflet) % leaflet_colours.size()];
}

std::string grouped(vtkIdType n) {
  std::string digits = std::to_string(n);
  for (std::size_t i = digits.size(); i > 3;) digits.insert(i -= 3, ",");
  return digits;
}

void add_text(vtkRenderer *renderer, const std::string &text, double x, double y, int size, const double (&colour)[3]) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(x, y);
  vtkTextProperty *property = actor->GetTextProperty();
  property->SetFontFamilyToArial();
  property->SetFontSize(size);
  property->SetColor(colour[0], colour[1], colour[2]);
  // A large mesh runs behind the texts.
  property->SetBackgroundColor(1, 1, 1);
  property->SetBackgroundOpacity(0.8);
  renderer->AddViewProp(actor);
}

void add_caption(vtkRenderer *renderer, const std::string &text, int size) {
  add_text(renderer, text, 0.03, 0.94, size, {text_grey, text_grey, text_grey});
}

std::string name_of(vtkIdType leaflet, const PanelTexts &texts) {
  const auto at = static_cast<std::size_t>(leaflet);
  return at < texts.leaflet_names.size() ? texts.leaflet_names[at] : "leaflet " + std::to_string(leaflet);
}

// The names of the leaflets in their colours, along the lower edge, as many as fit.
void add_key(vtkRenderer *renderer, const std::set<vtkIdType> &leaflets, const PanelTexts &texts) {
  double x = 0.03;
  for (const vtkIdType leaflet : leaflets) {
    const std::string name = name_of(leaflet, texts);
    // Letters are half as wide as they are high, on average less.
    const double width = 0.55 * texts.size * static_cast<double>(name.size()) / texts.panel_width;
    if (x + width > 1) break;
    const Colour colour = colour_of(leaflet);
    add_text(renderer, name, x, 0.03, texts.size, {colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0});
    x += width + 1.5 * texts.size / texts.panel_width;
  }
}

vtkSmartPointer<vtkRenderer> empty_panel() {
  const auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetBackground(1, 1, 1);
  renderer->TwoSidedLightingOn();
  vtkNew<vtkLightKit> lights;
  lights->AddLightsToRenderer(renderer);
  return renderer;
}

vtkSmartPointer<vtkActor> actor_of(vtkPolyData *data) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

// Gives every face the colour of its leaflet, and returns which leaflets there are.
std::set<vtkIdType> colour_faces(vtkPolyData *faces) {
  vtkDataArray *leaflet = faces->GetCellData()->GetArray(leaflet_array);
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName("colour");
  colours->SetNumberOfComponents(3);
  std::set<vtkIdType> leaflets;
  for (vtkIdType i = 0; i < faces->GetNumberOfCells(); ++i) {
    const auto id = static_cast<vtkIdType>(leaflet->GetTuple1(i));
    leaflets.insert(id);
    colours->InsertNextTypedTuple(colour_of(id).data());
  }
  faces->GetCellData()->SetScalars(colours);
  return leaflets;
}

void add_coloured(vtkRenderer *renderer, vtkPolyData *faces) {
  const vtkSmartPointer<vtkActor> actor = actor_of(faces);
  actor->GetMapper()->SetScalarModeToUseCellData();
  actor->GetMapper()->SetColorModeToDirectScalars();
  // Some light of its own, so that what faces away from the lamps keeps its colour.
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetDiffuse(0.85);
  actor->GetProperty()->SetSpecular(0.15);
  actor->GetProperty()->SetSpecularPower(20);
  renderer->AddActor(actor);
}

// For each cell the leaflet of its closest node if all its nodes are marked, else -1.
vtkSmartPointer<vtkTypeInt32Array> leaflets_of_cells(vtkUnstructuredGrid *grid) {
  vtkDataArray *marked = grid->GetPointData()->GetArray(marked_array);
  vtkDataArray *distance = grid->GetPointData()->GetArray(distance_array);
  vtkDataArray *leaflet = grid->GetPointData()->GetArray(leaflet_array);
  const auto leaflets = vtkSmartPointer<vtkTypeInt32Array>::New();
  leaflets->SetName(leaflet_array);
  leaflets->SetNumberOfValues(grid->GetNumberOfCells());
  vtkNew<vtkIdList> nodes;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    grid->GetCellPoints(cell, nodes);
    vtkIdType closest = -1;
    bool all_marked = true;
    for (const vtkIdType node : *nodes) {
      all_marked = all_marked && marked->GetTuple1(node) != 0;
      if (closest < 0 || distance->GetTuple1(node) < distance->GetTuple1(closest)) closest = node;
    }
    leaflets->SetValue(cell, all_marked && closest >= 0 ? static_cast<vtkTypeInt32>(leaflet->GetTuple1(closest)) : -1);
  }
  return leaflets;
}

// The outside of the marked cells.
vtkSmartPointer<vtkPolyData> marked_faces(vtkUnstructuredGrid *grid, vtkIdType &n_cells) {
  vtkNew<vtkUnstructuredGrid> coloured;
  coloured->CopyStructure(grid);
  coloured->GetCellData()->AddArray(leaflets_of_cells(grid));
  vtkNew<vtkThreshold> threshold;
  threshold->SetInputData(coloured);
  threshold->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, leaflet_array);
  threshold->SetThresholdFunction(vtkThreshold::THRESHOLD_UPPER);
  threshold->SetUpperThreshold(0);
  vtkNew<vtkDataSetSurfaceFilter> outside;
  outside->SetInputConnection(threshold->GetOutputPort());
  outside->Update();
  n_cells = threshold->GetOutput()->GetNumberOfCells();
  return outside->GetOutput();
}

void add_outline(vtkRenderer *renderer, vtkUnstructuredGrid *grid) {
  vtkNew<vtkUnstructuredGrid> bare;
  bare->CopyStructure(grid);
  vtkNew<vtkDataSetSurfaceFilter> boundary;
  boundary->SetInputData(bare);
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputConnection(boundary->GetOutputPort());
  edges->SetFeatureAngle(30);
  edges->NonManifoldEdgesOff();
  edges->ManifoldEdgesOff();
  edges->ColoringOff();
  edges->Update();

  const vtkSmartPointer<vtkActor> skin = actor_of(boundary->GetOutput());
  skin->GetProperty()->SetColor(outline_grey, outline_grey, outline_grey);
  skin->GetProperty()->SetOpacity(0.08);
  skin->GetProperty()->LightingOff();
  renderer->AddActor(skin);
  const vtkSmartPointer<vtkActor> lines = actor_of(edges->GetOutput());
  lines->GetProperty()->SetColor(outline_grey, outline_grey, outline_grey);
  lines->GetProperty()->LightingOff();
  lines->GetProperty()->SetLineWidth(1.5F);
  renderer->AddActor(lines);
}

vtkIdType n_marked_nodes(vtkUnstructuredGrid *grid) {
  vtkDataArray *marked = grid->GetPointData()->GetArray(marked_array);
  vtkIdType n = 0;
  for (vtkIdType node = 0; node < grid->GetNumberOfPoints(); ++node) n += marked->GetTuple1(node) != 0;
  return n;
}

}  // namespace

vtkSmartPointer<vtkRenderer> surface_panel(vtkPolyData *surface, const PanelTexts &texts) {
  const vtkSmartPointer<vtkRenderer> renderer = empty_panel();
  const std::set<vtkIdType> leaflets = colour_faces(surface);
  vtkNew<vtkPolyDataNormals> smooth;
  smooth->SetInputData(surface);
  smooth->SetFeatureAngle(40);
  smooth->ConsistencyOff();
  smooth->Update();
  add_coloured(renderer, smooth->GetOutput());
  add_caption(renderer, texts.title + ": " + grouped(surface->GetNumberOfCells()) + " triangles", texts.size);
  add_key(renderer, leaflets, texts);
  return renderer;
}

vtkSmartPointer<vtkRenderer> marks_panel(vtkUnstructuredGrid *grid, const PanelTexts &texts) {
  const vtkSmartPointer<vtkRenderer> renderer = empty_panel();
  vtkIdType n_cells = 0;
  const vtkSmartPointer<vtkPolyData> faces = marked_faces(grid, n_cells);
  colour_faces(faces);
  add_coloured(renderer, faces);
  add_outline(renderer, grid);
  add_caption(renderer,
              "Marked: " + grouped(n_marked_nodes(grid)) + " of " + grouped(grid->GetNumberOfPoints()) + " nodes, " +
                  grouped(n_cells) + " whole cells",
              texts.size);
  return renderer;
}

}  // namespace riis::vtk
