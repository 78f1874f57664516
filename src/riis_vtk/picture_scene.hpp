// SPDX-License-Identifier: Apache-2.0
// The window of a picture has panels, and bands above and below them with captions, the key of colours, axes and a scale bar.
// It can show several surfaces and marks one after the other, each from any side.
#pragma once

#include <riis/riis_vtk.h>

#include <optional>
#include <string>

#include <vtkNew.h>

#include "riis_vtk/picture_panels.hpp"

class vtkCamera;
class vtkRenderWindow;

namespace riis::vtk {

// The places of a picture's parts, in pixels from the lower left corner. A picture that is too low for bands has neither bands
// nor texts.
class Layout {
 public:
  Layout(int width, int height, int n_panels);
  bool has_texts() const { return top_ > 0; }
  int n_panels() const { return n_panels_; }
  int letter() const { return letter_; }  // the height of the texts' font
  int margin() const { return letter_; }
  double panel_left(int panel) const { return width_ * static_cast<double>(panel) / n_panels_; }
  double panel_width() const { return width_ / static_cast<double>(n_panels_); }
  double panel_height() const { return height_ - top_ - bottom_; }
  // Return the lower end of a line of text. The caption's lines are counted from the top, the key's lines from the panels
  // downwards.
  double caption_line(int line) const { return height_ - 1.6 * letter_ * (line + 1); }
  double key_line(int line) const { return bottom_ - 1.6 * letter_ * (line + 1); }
  double bottom() const { return bottom_; }
  // The left, lower, right and upper end, as shares of the picture's size.
  std::array<double, 4> viewport(int panel) const;
  double line_width() const;

 private:
  int width_, height_, n_panels_, letter_;
  double top_ = 0, bottom_ = 0;
};

struct KeyEntry {
  std::string text;
  Colour colour;
};

struct PanelTexts {
  std::vector<std::string> caption;  // lines
  std::vector<KeyEntry> key;         // as many as fit
};

// Edges to draw red. NULL: the texts do not mention leaks.
struct Leaks {
  std::int64_t n_edges = 0;
  const std::int64_t *edges = nullptr;
};

// Fails unless the mesh has the arrays of riis_vtk_mesh_set_marks.
void check_has_marks(const riis_vtk_mesh *mesh);

class Scene {
 public:
  // grid NULL: the surface alone.
  Scene(vtkUnstructuredGrid *grid, const riis_vtk_picture_options &options);
  ~Scene();
  // Shows the surface, and the marks that the grid has now. title NULL: "Surface".
  void show(const riis_surface *surface, const char *title, const Leaks &leaks);
  // The box that the camera shows, or nothing for the surface's box.
  vtkRenderWindow *render(std::int32_t of, const std::optional<Bounds> &seen);

 private:
  void add_panel(vtkRenderer *renderer, int panel);

  Layout layout_;
  std::string unit_;  // "" if the caller gave none
  std::vector<std::string> leaflet_names_;
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
  vtkSmartPointer<vtkPolyData> triangles_;
  SurfacePanel surface_;
  std::optional<MarksPanel> marks_;
  std::vector<PanelTexts> texts_;
  vtkNew<vtkCamera> camera_;
  vtkNew<vtkRenderWindow> window_;
  vtkSmartPointer<vtkRenderer> behind_;
};

}  // namespace riis::vtk
