// SPDX-License-Identifier: Apache-2.0
// Pictures of riis_vtk.h: a surface and a marked mesh, seen by one camera, to .png files.
#include <riis/riis_vtk.h>

#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "vtk/array_names.hpp"
#include "vtk/display.hpp"
#include "vtk/drawing.hpp"
#include "vtk/files.hpp"
#include "vtk/mesh.hpp"
#include "vtk/picture_options.hpp"
#include "vtk/picture_panels.hpp"
#include "vtk/picture_texts.hpp"
#include "vtk/picture_view.hpp"
#include "vtk/surface_polydata.hpp"
#include "vtk/vtk_errors.hpp"

namespace riis::vtk {
namespace {

void check_has_marks(const riis_vtk_mesh *mesh) {
  for (const char *name : {marked_array, distance_array, leaflet_array}) {
    if (!mesh->grid->GetPointData()->GetArray(name)) {
      fail(RIIS_INVALID_ARGUMENT, "mesh has no marks: call riis_vtk_mesh_set_marks before riis_vtk_draw");
    }
  }
}

void write_png(vtkRenderWindow *window, const std::string &path, const CaughtOutput &caught) {
  ReplacingFile file(path);
  const vtkSmartPointer<vtkUnsignedCharArray> bytes = encoded_png(window);
  caught.check(path);
  if (!bytes) fail_file(path, "could not be encoded");
  file.write(bytes->GetPointer(0), bytes->GetNumberOfValues());
  file.commit("IEND");
}

// The texts of a picture that do not change with its view.
std::vector<PanelTexts> texts_of(const riis_vtk_picture_options &options, const SurfacePanel &surface,
                                 vtkIdType n_triangles, const MarkCounts *marks) {
  const std::string title = options.title ? drawable(options.title) : "Surface";
  std::vector<PanelTexts> panels = {{{title + ": " + counted(n_triangles, "triangle")}, {}}};
  for (const vtkIdType leaflet : surface.leaflets) {
    const bool named = leaflet >= 0 && leaflet < options.n_leaflet_names;
    panels[0].key.push_back({named ? drawable(options.leaflet_names[leaflet]) : "leaflet " + std::to_string(leaflet),
                             colour_of_leaflet(leaflet)});
  }
  if (!marks) return panels;
  std::string cells = grouped(marks->n_whole_cells) + " whole, " + grouped(marks->n_partly_cells) + " partly marked " +
                      (marks->n_partly_cells == 1 ? "cell" : "cells");
  std::vector<KeyEntry> key = {{"pale: partly marked", grey}};
  if (options.leaking_edges) {
    cells += ", " + counted(options.n_leaking_edges, "leaking edge");
    if (options.n_leaking_edges > 0) key.push_back({"leaking edges", leak_colour});
  }
  panels.push_back(
      {{"Marked: " + grouped(marks->n_marked_nodes) + " of " + counted(marks->n_nodes, "node"), cells}, key});
  return panels;
}

// The parts that all views of one picture share.
class Scene {
 public:
  Scene(const riis_surface *surface, const riis_vtk_mesh *mesh, const riis_vtk_picture_options &options)
      : layout_(options.width, options.height, mesh ? 2 : 1),
        triangles_(polydata_of(surface)),
        mesh_(mesh ? mesh->grid : nullptr),
        surface_(surface_panel(triangles_)) {
    if (mesh_) marks_.emplace(mesh_, options.n_leaking_edges, options.leaking_edges, layout_.line_width());
    texts_ = texts_of(options, surface_, triangles_->GetNumberOfCells(), marks_ ? &marks_->counts() : nullptr);
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(4);
    window_->SetSize(options.width, options.height);
    window_->SetNumberOfLayers(2);
    add_panel(surface_.renderer, 0);
    if (marks_) add_panel(marks_->renderer(), 1);
  }

  vtkRenderWindow *render(std::int32_t of) {
    const View view(of);
    const Extents surface = view.extents_of(triangles_);
    const Extents mesh = mesh_ ? view.extents_of(mesh_) : surface;
    const Sight sight = sight_of(surface, mesh_ ? &mesh : nullptr, layout_.panel_width() / layout_.panel_height());
    aim_camera(camera_, view, sight);
    std::vector<PanelTexts> texts = texts_;
    if (marks_) {
      marks_->look(view, sight);
      if (sight.is_cut()) texts[1].key.push_back({"dashed: the mesh goes on", grey});
    }
    if (behind_) window_->RemoveRenderer(behind_);
    behind_ = texts_of_picture(layout_, texts, view, sight, mesh_ ? "mesh unit" : "unit");
    window_->AddRenderer(behind_);
    surface_.renderer->ResetCameraClippingRange();
    if (marks_) marks_->renderer()->ResetCameraClippingRange();
    window_->Render();
    return window_;
  }

 private:
  void add_panel(vtkRenderer *renderer, int panel) {
    const std::array<double, 4> part = layout_.viewport(panel);
    renderer->SetViewport(part[0], part[1], part[2], part[3]);
    renderer->SetLayer(1);
    renderer->SetActiveCamera(camera_);
    window_->AddRenderer(renderer);
  }

  Layout layout_;
  vtkSmartPointer<vtkPolyData> triangles_;
  vtkUnstructuredGrid *mesh_;
  SurfacePanel surface_;
  std::optional<MarksPanel> marks_;
  std::vector<PanelTexts> texts_;
  vtkNew<vtkCamera> camera_;
  vtkNew<vtkRenderWindow> window_;
  vtkSmartPointer<vtkRenderer> behind_;
};

struct Shot {
  std::int32_t view;
  std::string path;
};

void draw(const riis_surface *surface, const riis_vtk_mesh *mesh, const riis_vtk_picture_options &options,
          const std::vector<Shot> &shots, const CaughtOutput &caught) {
  for (const Shot &shot : shots) {
    if (ending_of(shot.path) != "png") fail_file(shot.path, "the file's ending must be .png");
  }
  check_picture_options(options, mesh);
  if (mesh) check_has_marks(mesh);
  if (shots.empty()) return;
  const HeldDisplay display;
  Scene scene(surface, mesh, options);
  for (const Shot &shot : shots) {
    vtkRenderWindow *window = scene.render(shot.view);
    caught.check(shot.path);
    write_png(window, shot.path, caught);
  }
}

}  // namespace
}  // namespace riis::vtk

using namespace riis::vtk;

extern "C" {

RIIS_API riis_status riis_vtk_picture_options_init(riis_vtk_picture_options *options, int64_t struct_size) {
  return guarded([&](const CaughtOutput &) {
    require(options, "options");
    check_picture_options_size(struct_size);
    std::memcpy(options, &default_picture_options(), static_cast<std::size_t>(struct_size));
    options->struct_size = struct_size;
  });
}

RIIS_API riis_status riis_vtk_draw(const riis_surface *surface, const riis_vtk_mesh *mesh,
                                   const riis_vtk_picture_options *options, const char *path) {
  return guarded([&](const CaughtOutput &caught) {
    require(surface, "surface");
    require(path, "path");
    const riis_vtk_picture_options whole = completed_picture_options(options);
    check_view(whole.view, "options->view");
    draw(surface, mesh, whole, {{whole.view, path}}, caught);
  });
}

RIIS_API riis_status riis_vtk_draw_views(const riis_surface *surface, const riis_vtk_mesh *mesh,
                                         const riis_vtk_picture_options *options, int64_t n_views, const int32_t *views,
                                         const char *const *paths) {
  return guarded([&](const CaughtOutput &caught) {
    require(surface, "surface");
    if (n_views < 0) fail(RIIS_INVALID_ARGUMENT, "n_views is " + std::to_string(n_views));
    if (n_views > 0) {
      require(views, "views");
      require(paths, "paths");
    }
    std::vector<Shot> shots;
    for (int64_t i = 0; i < n_views; ++i) {
      const std::string place = "[" + std::to_string(i) + "]";
      check_view(views[i], ("views" + place).c_str());
      shots.push_back({views[i], require(paths[i], ("paths" + place).c_str())});
    }
    draw(surface, mesh, completed_picture_options(options), shots, caught);
  });
}

}  // extern "C"
