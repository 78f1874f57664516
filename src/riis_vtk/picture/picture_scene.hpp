// SPDX-License-Identifier: Apache-2.0
// The window of a picture. It has panels, and bands above and below them with captions, the key of colours, axes and a scale
// bar. It can show several surfaces and marks one after another, each in any view.
#pragma once

#include <riis/riis_vtk.h>

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

class vtkCamera;
class vtkImageData;
class vtkRenderWindow;
class vtkActor;
class vtkUnstructuredGrid;
class vtkPointSet;
class vtkPolyData;

namespace riis::vtk {

// The view.
// In: the direction of view, and the extents of the surface and the mesh. Out: the visible space, for the camera, the cut and the
// scale bar. If the mesh extends beyond the panel, planes cut it, and dashed lines show the cuts.

using Vector = std::array<double, 3>;

struct Extent {
  double lower, upper;
  double middle() const { return 0.5 * lower + 0.5 * upper; }
  double half() const { return 0.5 * upper - 0.5 * lower; }
  bool meets(const Extent &other) const { return lower <= other.upper && other.lower <= upper; }
};

// Extents along the axes of a view: to the right, upwards, and away from the eye.
using Extents = std::array<Extent, 3>;
// Extents along x, y and z.
using Bounds = std::array<Extent, 3>;

// The unit vectors along a valve's own x, y and z, after its placement.
using Axes = std::array<Vector, 3>;

// Returns the mesh's axes, turned about an axis of any length other than 0.
Axes axes_turned(const double axis[3], double degrees);

// A view without perspective, so that lengths can be compared. right, up and away are perpendicular unit vectors.
struct View {
  std::array<Vector, 3> axes;

  // `view` is RIIS_VTK_VIEW_*, but not one of three views. `valve` is used by the views that look by the valve's axes.
  View(std::int32_t view, const Axes &valve);
  const Vector &right() const { return axes[0]; }
  const Vector &up() const { return axes[1]; }
  const Vector &away() const { return axes[2]; }
  Extents extents_of(vtkPointSet *data) const;
  // Returns the extents of the whole box.
  Extents extents_of(const Bounds &bounds) const;
};

// The part of space that a panel shows, along the axes of its view.
struct Sight {
  Extents shown;                  // x and y extend to the panel's edges; z is the depth of surface and mesh
  std::array<Extent, 2> uncut;    // x and y at which the mesh is cut if it extends further
  std::array<bool, 2> cut_below;  // whether the mesh is cut on the left, and below
  std::array<bool, 2> cut_above;  // whether the mesh is cut on the right, and above
  bool is_cut() const { return cut_below[0] || cut_below[1] || cut_above[0] || cut_above[1]; }
};

// Returns a sight that contains the surface. Along an axis on which the mesh is not much larger, the sight also contains the
// mesh. So pictures of a valve that moves in one mesh can be compared. Along other axes, the sight contains the surface's
// neighbourhood.
//   mesh    NULL if there is none
//   aspect  the panel's width divided by its height
//   least   the least half height of the panel, so that several views can have one scale
Sight sight_of(const Extents &surface, const Extents *mesh, double aspect, double least = 0);

void aim_camera(vtkCamera *camera, const View &view, const Sight &sight);

// Returns planes for the mapper of the mesh. There are none if the whole mesh is in sight.
std::vector<vtkSmartPointer<vtkPlane>> cutting_planes(const View &view, const Sight &sight);

// Returns dashed lines where the planes cut the boundary. The lines are nearer to the eye than everything else.
vtkSmartPointer<vtkPolyData> dashes_where_cut(const View &view, const Sight &sight, vtkPolyData *boundary);

// Red, green and blue, each from 0 to 1.
using Colour = std::array<double, 3>;

Colour colour_of_leaflet(vtkIdType leaflet);
// A dark red, which no colour vision confuses with the leaflets' vermilion.
constexpr Colour leak_colour = {0.55, 0.0, 0.0};
constexpr Colour grey = {0.2, 0.2, 0.2};

// The panel with the surface, in which each leaflet has its own colour. The rims are drawn as lines, because faces that are seen
// edge-on cover no pixels.
class SurfacePanel {
 public:
  // `pixels` is the width of a line.
  explicit SurfacePanel(double pixels);
  // Replaces the surface that was shown before.
  void show(vtkPolyData *surface);
  // Turns to a view. The lines are drawn slightly behind the faces, so that nearer faces hide the lines.
  void look(const View &view, const Sight &sight);
  vtkRenderer *renderer() const { return renderer_; }
  const std::set<vtkIdType> &leaflets() const { return leaflets_; }

 private:
  vtkSmartPointer<vtkRenderer> renderer_;
  double pixels_;
  vtkSmartPointer<vtkActor> rims_;
  std::set<vtkIdType> leaflets_;
};

struct MarkCounts {
  vtkIdType n_nodes = 0, n_marked_nodes = 0;
  vtkIdType n_whole_cells = 0;   // cells with all nodes marked
  vtkIdType n_partly_cells = 0;  // cells with some but not all nodes marked
};

// The panel with marked cells inside the faint boundary of the mesh. A cell has the colour of its closest node's leaflet. If it
// is partly marked, the colour is paler. Leaking edges are red. Cells below the grid's largest dimension are left out.
class MarksPanel {
 public:
  // `pixels` is the width of a line.
  MarksPanel(vtkUnstructuredGrid *grid, double pixels);
  // Shows the marks in the grid's point arrays instead of earlier marks. leaking_edges(2, n_leaking_edges) must hold valid node
  // ids.
  void show(vtkUnstructuredGrid *grid, std::int64_t n_leaking_edges, const std::int64_t *leaking_edges);
  vtkRenderer *renderer() const { return renderer_; }
  const MarkCounts &counts() const { return counts_; }
  // Turns to a view. Cuts a mesh that extends beyond the panel, and moves leaking edges in front of everything else.
  void look(const View &view, const Sight &sight);

 private:
  void add_marks(vtkUnstructuredGrid *grid);
  void add_leaks(vtkUnstructuredGrid *grid, std::int64_t n, const std::int64_t *edges);
  void add_outline(vtkUnstructuredGrid *grid);

  vtkSmartPointer<vtkRenderer> renderer_;
  MarkCounts counts_;
  double pixels_;
  double partly_length_ = 0;                                                 // mean edge length of partly marked cells
  vtkSmartPointer<vtkActor> partly_, whole_, leaks_, skin_, outline_, cut_;  // leaks_ is NULL without leaking edges
};

// The positions of a picture's parts, in pixels from the lower left corner. A picture that is not high enough for bands has no
// texts. The panels are side by side. In a column of three views they are above each other. Texts belong to a column of panels.
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
