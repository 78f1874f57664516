// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/picture_scene.hpp"

#include <array>

#include <vtkCamera.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>

#include "common/array_view.hpp"
#include "riis_vtk/files.hpp"
#include "riis_vtk/mesh.hpp"
#include "riis_vtk/surfaces.hpp"
#include "riis_vtk/vtk_errors.hpp"

namespace riis::vtk {
namespace {

// The texts of a picture that do not change with its view.
std::vector<PanelTexts> texts_of(const std::string &title, const std::vector<std::string> &names,
                                 const SurfacePanel &surface, vtkIdType n_triangles, const MarkCounts *marks,
                                 const Leaks &leaks) {
  std::vector<PanelTexts> panels = {{{title + ": " + counted(n_triangles, "triangle")}, {}}};
  for (const vtkIdType leaflet : surface.leaflets()) {
    const bool named = leaflet >= 0 && leaflet < view(names).size();
    panels[0].key.push_back(
        {named ? view(names)[leaflet] : "leaflet " + std::to_string(leaflet), colour_of_leaflet(leaflet)});
  }
  if (!marks) return panels;
  std::string cells = grouped(marks->n_whole_cells) + " whole, " + grouped(marks->n_partly_cells) + " partly marked " +
                      (marks->n_partly_cells == 1 ? "cell" : "cells");
  std::vector<KeyEntry> key = {{"pale: partly marked", grey}};
  if (leaks.edges) {
    cells += ", " + counted(leaks.n_edges, "leaking edge");
    if (leaks.n_edges > 0) key.push_back({"leaking edges", leak_colour});
  }
  panels.push_back(
      {{"Marked: " + grouped(marks->n_marked_nodes) + " of " + counted(marks->n_nodes, "node"), cells}, key});
  return panels;
}

}  // namespace

std::string title_of(const riis_vtk_picture_options &options) {
  return options.title ? drawable(options.title) : "Surface";
}

void check_has_marks(const riis_vtk_mesh *mesh) {
  for (const char *name : {marked_array, distance_array, leaflet_array}) {
    if (!mesh->grid->GetPointData()->GetArray(name)) {
      fail(RIIS_INVALID_ARGUMENT, "mesh has no marks: call riis_vtk_mesh_set_marks before riis_vtk_draw");
    }
  }
}

Scene::Scene(vtkUnstructuredGrid *grid, const riis_vtk_picture_options &options)
    : layout_(options.width, options.height, grid ? 2 : 1),
      unit_(options.unit ? drawable(options.unit) : ""),
      grid_(grid),
      surface_(layout_.line_width()) {
  for (std::int64_t i = 0; i < options.n_leaflet_names; ++i)
    leaflet_names_.push_back(drawable(options.leaflet_names[i]));
  if (grid_) marks_.emplace(grid_, layout_.line_width());
  window_->SetOffScreenRendering(1);
  window_->SetMultiSamples(4);
  window_->SetSize(options.width, options.height);
  window_->SetNumberOfLayers(2);
  add_panel(surface_.renderer(), 0);
  if (marks_) add_panel(marks_->renderer(), 1);
}

Scene::~Scene() = default;

void Scene::show(const riis_surface *surface, const std::string &title, const Leaks &leaks) {
  triangles_ = polydata_of(surface);
  surface_.show(triangles_);
  if (marks_) marks_->show(grid_, leaks.n_edges, leaks.edges);
  texts_ = texts_of(title, leaflet_names_, surface_, triangles_->GetNumberOfCells(),
                    marks_ ? &marks_->counts() : nullptr, leaks);
}

vtkRenderWindow *Scene::render(std::int32_t of, const std::optional<Bounds> &seen) {
  const View view(of);
  const Extents surface = seen ? view.extents_of(*seen) : view.extents_of(triangles_);
  const Extents mesh = grid_ ? view.extents_of(grid_) : surface;
  const Sight sight = sight_of(surface, grid_ ? &mesh : nullptr, layout_.panel_width() / layout_.panel_height());
  aim_camera(camera_, view, sight);
  surface_.look(view, sight);
  std::vector<PanelTexts> texts = texts_;
  if (marks_) {
    marks_->look(view, sight);
    if (sight.is_cut()) texts[1].key.push_back({"dashed: the mesh goes on", grey});
  }
  if (behind_) window_->RemoveRenderer(behind_);
  behind_ = texts_of_picture(layout_, texts, view, sight, unit_.empty() ? grid_ ? "mesh unit" : "unit" : unit_,
                             unit_.empty());
  window_->AddRenderer(behind_);
  surface_.renderer()->ResetCameraClippingRange();
  if (marks_) marks_->renderer()->ResetCameraClippingRange();
  window_->Render();
  return window_;
}

void Scene::add_panel(vtkRenderer *renderer, int panel) {
  const std::array<double, 4> part = layout_.viewport(panel);
  renderer->SetViewport(part[0], part[1], part[2], part[3]);
  renderer->SetLayer(1);
  renderer->SetActiveCamera(camera_);
  window_->AddRenderer(renderer);
}

}  // namespace riis::vtk
