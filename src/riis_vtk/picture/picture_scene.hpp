// SPDX-License-Identifier: Apache-2.0
// The window of a picture, which has one panel or several. Bands above and below the panels have the captions, the key of
// colours, axes and a scale bar. The window can show several surfaces and their marks one after another, each from any view.
#pragma once

#include <riis/riis_vtk.h>

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "riis_vtk/picture/picture_flow.hpp"
#include "riis_vtk/picture/picture_shell.hpp"
#include "riis_vtk/picture/picture_view.hpp"

class vtkCamera;
class vtkImageData;
class vtkRenderWindow;
class vtkActor;
class vtkUnstructuredGrid;
class vtkPointSet;
class vtkPolyData;

namespace riis::vtk {

Colour colour_of_leaflet(vtkIdType leaflet);
// A dark red for leaking edges. People with any kind of colour vision can tell this red from the vermilion of leaflets.
constexpr Colour leak_colour = {0.55, 0.0, 0.0};

// The panel with the surface, in which each leaflet has its own colour. The rims of leaflets are drawn as lines, because a face
// seen edge-on covers no pixels.
class SurfacePanel {
 public:
  // `pixels` is the width of a line.
  explicit SurfacePanel(double pixels);
  // Replaces the surface that was shown before.
  void show(vtkPolyData *surface);
  // Turns the panel to a view. The lines are drawn slightly behind the faces, so that nearer faces hide the lines.
  void look(const View &view, const Sight &sight);
  vtkRenderer *renderer() const { return renderer_; }
  const std::set<vtkIdType> &leaflets() const { return leaflets_; }

 private:
  vtkSmartPointer<vtkRenderer> renderer_;
  double pixels_;
  vtkSmartPointer<vtkActor> leaflets_drawn_, rims_;
  std::set<vtkIdType> leaflets_;
};

struct MarkCounts {
  vtkIdType n_nodes = 0, n_marked_nodes = 0;
  vtkIdType n_whole_cells = 0;   // cells with all nodes marked
  vtkIdType n_partly_cells = 0;  // cells with some but not all nodes marked
};

// The panel with the marked cells. A cell has the colour of the leaflet to which its closest marked node belongs. The colour of a
// partly marked cell is paler. Leaking edges are red. Cells whose dimension is below the largest in the grid are left out.
class MarksPanel {
 public:
  // `pixels` is the width of a line.
  explicit MarksPanel(double pixels);
  // Shows the marks of the grid's point arrays, and removes earlier marks. leaking_edges(2, n_leaking_edges) must contain valid
  // node ids.
  void show(vtkUnstructuredGrid *grid, std::int64_t n_leaking_edges, const std::int64_t *leaking_edges);
  vtkRenderer *renderer() const { return renderer_; }
  const MarkCounts &counts() const { return counts_; }
  // Turns the panel to a view. Moves leaking edges in front of everything else.
  void look(const View &view, const Sight &sight);

 private:
  void add_marks(vtkUnstructuredGrid *grid);
  void add_leaks(vtkUnstructuredGrid *grid, std::int64_t n, const std::int64_t *edges);

  vtkSmartPointer<vtkRenderer> renderer_;
  MarkCounts counts_;
  double pixels_;
  double partly_length_ = 0;                          // mean edge length of partly marked cells
  vtkSmartPointer<vtkActor> partly_, whole_, leaks_;  // leaks_ is NULL without leaking edges
};

// The positions of the parts of a picture, in pixels from the lower left corner. If a picture is too low for bands, it has no
// texts. Usually the panels are side by side. In a picture with three views, each column has the panels of one view, one above
// the other. Each text belongs to one column of panels.
class Layout {
 public:
  enum class Panels { side_by_side, stacked };
  // The value of `captions` is a constant RIIS_VTK_CAPTIONS_*.
  Layout(int width, int height, int n_panels, Panels panels, std::int32_t captions);
  bool has_captions() const { return top_ > 0; }
  bool has_scale() const { return bottom_ > 0; }
  int width() const { return width_; }
  int height() const { return height_; }
  int n_columns() const { return n_columns_; }
  int letter() const { return letter_; }  // the height of the texts' font
  int margin() const { return letter_; }
  double column_left(int column) const { return width_ * static_cast<double>(column) / n_columns_; }
  double panel_width() const { return width_ / static_cast<double>(n_columns_); }
  double panel_height() const { return (height_ - top_ - bottom_) / n_rows_; }
  // caption_line and key_line return the lower end of a line of text. The lines of a caption are counted from the top of the
  // picture downwards. The lines of a key are counted downwards from the panels.
  double caption_line(int line) const { return height_ - 1.6 * letter_ * (line + 1); }
  double key_line(int line) const { return bottom_ - 1.6 * letter_ * (line + 1); }
  double bottom() const { return bottom_; }
  // Returns the left, lower, right and upper end of a panel. Each of the four ends is a share of the picture's size.
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
  std::vector<std::string> caption = {};  // one entry for each line, at most two
  std::vector<KeyEntry> key = {};         // only the entries that fit are shown
  std::string upper_end = {};             // the speed at the end of the bar, with its unit; "" if there is no bar
};

// The leaking edges, which are drawn in red. If `edges` is NULL, the texts do not mention leaks.
struct Leaks {
  std::int64_t n_edges = 0;
  const std::int64_t *edges = nullptr;
};

// The options that determine the appearance of a picture.
struct Style {
  explicit Style(const riis_vtk_picture_options &options);
  Colour background;
  bool is_transparent;
  Colour ink, line;   // colours of texts, and of the wall's rims
  double shell_grey;  // the brightness of the wall
  std::int32_t captions, panels;
};

// Fails unless the mesh has the arrays of riis_vtk_mesh_set_marks.
void check_has_marks(const riis_vtk_mesh *mesh);

class Scene {
 public:
  // Makes the window. If `grid` is NULL, the window shows only a surface. A flow needs a grid.
  Scene(vtkUnstructuredGrid *grid, const riis_vtk_picture_options &options, const std::optional<Flow> &flow = {});
  ~Scene();
  // Shows the surface, and the present marks of the grid. If `title` is NULL, the title is "Surface".
  void show(const riis_surface *surface, const char *title, const Leaks &leaks);
  // Draws a view, or three views side by side. `seen` is the box that the camera shows. If the box is missing, the camera shows
  // the surface's box.
  vtkSmartPointer<vtkImageData> picture(std::int32_t of, const std::optional<Bounds> &seen);

 private:
  // Returns the view of the shown surface.
  View view_of(std::int32_t of);
  // Returns the part of space that a panel shows. The half height of a panel is never below `least`.
  Sight sight(const View &view, const std::optional<Bounds> &seen, const Layout &layout, double least = 0) const;
  // Draws one view. A transparent picture has a fourth channel for the opacity.
  vtkSmartPointer<vtkImageData> shot(const View &view, const Sight &sight, const Layout &layout,
                                     const std::vector<PanelTexts> &texts);
  vtkSmartPointer<vtkImageData> shot_on(const Colour &background);
  // Measures the flow in the planes of the views. Returns the texts of the panels.
  std::vector<PanelTexts> texts_for(const std::vector<View> &views);
  bool has_surface() const { return style_.panels != RIIS_VTK_PANELS_MARKS; }
  vtkSmartPointer<vtkImageData> three_views(std::int32_t first, const std::optional<Bounds> &seen);

  Style style_;
  Axes axes_;                      // of the valve
  std::optional<Axes> long_axes_;  // for RIIS_VTK_VIEW_VALVE_LONG; they are the same in all frames of a movie
  Layout layout_;                  // the layout of a picture with one view
  std::string unit_;               // "" if the caller gave none
  std::vector<std::string> leaflet_names_;
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
  vtkSmartPointer<vtkPolyData> triangles_;
  SurfacePanel surface_;
  std::optional<MarksPanel> marks_;  // missing if there is no mesh, if there is a flow, or if only the surface is shown
  std::optional<FlowPanel> flow_;    // takes the place of the marks
  vtkSmartPointer<vtkPointSet> around_;  // the grid, or the wall of the options; NULL if there is neither
  std::optional<Shell> shell_;           // set if there is a grid or a wall
  std::vector<std::string> title_;
  std::vector<PanelTexts> texts_;  // the texts of the panels, except the flow's panel
  vtkNew<vtkCamera> camera_;
  vtkNew<vtkRenderWindow> window_;
  vtkSmartPointer<vtkRenderer> behind_;
};

}  // namespace riis::vtk
