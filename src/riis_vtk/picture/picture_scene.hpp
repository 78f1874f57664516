// SPDX-License-Identifier: Apache-2.0
// The window of a picture. It has panels, and bands above and below them with captions, the key of colours, axes and a scale
// bar. It can show several surfaces and marks one after another, each in any view.
#pragma once

#include <riis/riis_vtk.h>

#include <optional>
#include <string>

#include <vtkNew.h>

#include "riis_vtk/picture/picture_panels.hpp"

class vtkCamera;
class vtkImageData;
class vtkRenderWindow;

namespace riis::vtk {

// The positions of a picture's parts, in pixels from the lower left corner. A picture that is not high enough for bands has no
// texts. The panels are side by side or, in a column of three views, above each other. Texts belong to a column of panels.
class Layout {
 public:
  enum class Panels { side_by_side, stacked };
  Layout(int width, int height, int n_panels, Panels panels);
  bool has_texts() const { return top_ > 0; }
  int width() const { return width_; }
  int height() const { return height_; }
  int n_columns() const { return n_columns_; }
  int letter() const { return letter_; }  // the height of the texts' font
  int margin() const { return letter_; }
  double column_left(int column) const { return width_ * static_cast<double>(column) / n_columns_; }
  double panel_width() const { return width_ / static_cast<double>(n_columns_); }
  double panel_height() const { return (height_ - top_ - bottom_) / n_rows_; }
  // Both functions return the lower end of a line of text. The caption's lines are counted from the top of the picture. The key's
  // lines are counted downwards from the panels.
  double caption_line(int line) const { return height_ - 1.6 * letter_ * (line + 1); }
  double key_line(int line) const { return bottom_ - 1.6 * letter_ * (line + 1); }
  double bottom() const { return bottom_; }
  // Returns the left, lower, right and upper end of a panel, as shares of the picture's size.
  std::array<double, 4> viewport(int panel) const;
  double line_width() const;

 private:
  int width_, height_, n_columns_, n_rows_, letter_;
  double top_ = 0, bottom_ = 0;
};

struct KeyEntry {
  std::string text;
  Colour colour;
};

struct PanelTexts {
  std::vector<std::string> caption;  // one entry for each line
  std::vector<KeyEntry> key;         // as many as fit are shown
};

// Leaking edges, which are drawn in red. If `edges` is NULL, the texts do not mention leaks.
struct Leaks {
  std::int64_t n_edges = 0;
  const std::int64_t *edges = nullptr;
};

// Fails unless the mesh has the arrays of riis_vtk_mesh_set_marks.
void check_has_marks(const riis_vtk_mesh *mesh);

class Scene {
 public:
  // Makes the window. If `grid` is NULL, it shows only the surface.
  Scene(vtkUnstructuredGrid *grid, const riis_vtk_picture_options &options);
  ~Scene();
  // Shows the surface, and the marks that the grid has at present. If `title` is NULL, the title is "Surface".
  void show(const riis_surface *surface, const char *title, const Leaks &leaks);
  // Draws a view, or three views side by side. `seen` is the box that the camera shows. Without it, the camera shows the
  // surface's box.
  vtkSmartPointer<vtkImageData> picture(std::int32_t of, const std::optional<Bounds> &seen);

 private:
  // `least` is the least half height of a panel.
  Sight sight(const View &view, const std::optional<Bounds> &seen, const Layout &layout, double least = 0) const;
  vtkSmartPointer<vtkImageData> shot(const View &view, const Sight &sight, const Layout &layout,
                                     const std::vector<PanelTexts> &texts);
  vtkSmartPointer<vtkImageData> three_views(std::int32_t first, const std::optional<Bounds> &seen);

  Axes axes_;         // of the valve
  Layout layout_;     // of a picture with one view
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
