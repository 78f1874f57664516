// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/picture/picture_scene.hpp"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCoordinate.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnstructuredGrid.h>

#include "common/array_view.hpp"
#include "common/elementary.hpp"
#include "riis_vtk/mesh/mesh.hpp"
#include "riis_vtk/mesh/outside_faces.hpp"
#include "riis_vtk/picture/drawing.hpp"
#include "riis_vtk/surface/surfaces.hpp"

namespace riis::vtk {
namespace {

constexpr int least_letter = 6;
constexpr int least_height_with_texts = 120;
constexpr std::int32_t n_views = 3;  // the number of views in a picture of three views
// A picture of a flow shows more of the mesh, because a jet is longer than its valve.
constexpr double reach_of_flow = 4;
constexpr const char *view_names[] = {"side", "top", "oblique"};

// Returns the number with commas between thousands.
std::string grouped(vtkIdType n) {
  std::string digits = std::to_string(n);
  for (std::size_t i = digits.size(); i > 3;) digits.insert(i -= 3, ",");
  return digits;
}

// Returns texts such as "1 edge" and "1,200 edges".
std::string counted(vtkIdType n, const std::string &singular) {
  return grouped(n) + " " + singular + (n == 1 ? "" : "s");
}

// Returns the largest number up to the limit that is 1, 2 or 5 times a power of ten.
double round_length(double limit) {
  const double power = std::pow(10, std::floor(std::log10(limit)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= limit) return digit * power;
  }
  return power;
}

// Replaces all characters that VTK cannot draw in one line of text. VTK would read letters outside ASCII as UTF-8.
std::string drawable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

int width_of(const std::string &text, int letter) {
  if (text.empty()) return 0;
  vtkNew<vtkTextProperty> property;
  set_font(property, letter);
  int box[4] = {0, -1, 0, -1};
  vtkTextRenderer::GetInstance()->GetBoundingBox(property, text, box, 72);
  return box[1] - box[0] + 1;
}

void add_text(vtkRenderer *renderer, const std::string &text, double x, double y, int letter, const Colour &colour) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  actor->SetPosition(x, y);
  set_font(actor->GetTextProperty(), letter);
  actor->GetTextProperty()->SetColor(colour[0], colour[1], colour[2]);
  renderer->AddViewProp(actor);
}

// Adds a text. If the text is too long, its letters become smaller. If the text is too long even with the smallest letters, its
// end is cut off.
void add_fitting_text(vtkRenderer *renderer, std::string text, double x, double y, double width, int letter,
                      const Colour &colour) {
  while (letter > least_letter && width_of(text, letter) > width) --letter;
  if (width_of(text, letter) > width) {
    while (!text.empty() && width_of(text + "...", letter) > width) text.pop_back();
    text += "...";
  }
  add_text(renderer, text, x, y, letter, colour);
}

struct Line {
  double from[2], to[2];
};

void add_lines(vtkRenderer *renderer, const std::vector<Line> &lines, double width, const Colour &colour) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const Line &line : lines) {
    const vtkIdType ends[2] = {points->InsertNextPoint(line.from[0], line.from[1], 0),
                               points->InsertNextPoint(line.to[0], line.to[1], 0)};
    cells->InsertNextCell(2, ends);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  vtkNew<vtkCoordinate> pixels;
  pixels->SetCoordinateSystemToViewport();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  mapper->SetTransformCoordinate(pixels);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  renderer->AddViewProp(actor);
}

// Adds the scale bar, whose length is a round number. The number and its unit stand beside the bar.
void add_scale_bar(vtkRenderer *renderer, const Layout &layout, double x, double y, const Sight &sight,
                   const std::string &unit, bool has_plural, const Colour &ink) {
  const double pixels_per_length = layout.panel_height() / (2 * sight.shown[1].half());
  const double length = round_length(0.3 * layout.panel_width() / pixels_per_length);
  const double end = x + length * pixels_per_length, middle = y + 0.35 * layout.letter(), tick = 0.3 * layout.letter();
  add_lines(renderer,
            {{{x, middle}, {end, middle}},
             {{x, middle - tick}, {x, middle + tick}},
             {{end, middle - tick}, {end, middle + tick}}},
            layout.line_width(), ink);
  std::ostringstream text;
  text.imbue(std::locale::classic());
  // A length in metres is shown in millimetres, as is usual for valves.
  const bool is_small = unit == "m" && length < 0.1;
  text << (is_small ? 1000 * length : length) << " " << (is_small ? "mm" : unit)
       << (length == 1 || !has_plural ? "" : "s");
  const double after = end + 0.6 * layout.letter();
  const double right = layout.column_left(layout.n_columns() - 1) + layout.panel_width();
  add_fitting_text(renderer, text.str(), after, y, right - after, layout.letter(), ink);
}

// Adds arrows for x, y and z. The length of an arrow shows how long its axis appears in the view. If an axis points towards the
// eye, its name stands at the origin of the arrows.
void add_axes(vtkRenderer *renderer, const Layout &layout, double x, double y, double length, const View &view,
              const Colour &ink) {
  const char *const names[3] = {"x", "y", "z"};
  std::vector<Line> lines;
  for (std::size_t k = 0; k < 3; ++k) {
    const double dx = view.right()[k], dy = view.up()[k], part = hypotenuse(dx, dy);
    const double half = 0.3 * layout.letter();
    if (part < 0.05) {
      add_text(renderer, names[k], x - 3 * half, y - 3 * half, layout.letter(), ink);
      continue;
    }
    const double tip[2] = {x + length * dx, y + length * dy};
    lines.push_back({{x, y}, {tip[0], tip[1]}});
    const double beyond = (length * part + 2 * half) / part;
    add_text(renderer, names[k], x + beyond * dx - half, y + beyond * dy - half, layout.letter(), ink);
  }
  add_lines(renderer, lines, layout.line_width(), ink);
}

void add_caption(vtkRenderer *renderer, const Layout &layout, int column, const std::vector<std::string> &lines,
                 const Colour &ink) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].empty()) continue;
    add_fitting_text(renderer, lines[i], layout.column_left(column) + layout.margin(),
                     layout.caption_line(static_cast<int>(i)), layout.panel_width() - 2 * layout.margin(),
                     layout.letter(), ink);
  }
}

// Adds the key of colours, from `left` to the right end of the column, in one or more lines. Entries that do not fit are replaced
// by dots.
void add_key(vtkRenderer *renderer, const Layout &layout, int column, double left, int n_lines,
             const std::vector<KeyEntry> &key) {
  const double right = layout.column_left(column) + layout.panel_width() - layout.margin();
  const double gap = 1.5 * layout.letter();
  const std::string dots = "...";
  const double width_of_dots = width_of(dots, layout.letter());
  double x = left;
  int line = 0;
  for (std::size_t i = 0; i < key.size(); ++i) {
    const double width = width_of(key[i].text, layout.letter());
    const auto fits = [&] {
      const bool is_followed = line + 1 == n_lines && i + 1 < key.size();
      return x + width + (is_followed ? gap + width_of_dots : 0) <= right;
    };
    if (!fits() && line + 1 < n_lines) {
      x = left;
      ++line;
    }
    if (!fits()) {
      add_text(renderer, dots, x, layout.key_line(line), layout.letter(), key[i].colour);
      return;
    }
    add_text(renderer, key[i].text, x, layout.key_line(line), layout.letter(), key[i].colour);
    x += width + gap;
  }
}

// Adds the bar of the colours of speeds, from 0 to its upper end.
void add_speed_bar(vtkRenderer *renderer, const Layout &layout, double x, double y, double right,
                   const std::string &upper_end, const Colour &ink) {
  constexpr int n_steps = 64;
  const double gap = 0.5 * layout.letter(), begin = x + width_of("0", layout.letter()) + gap;
  const double end = std::max(
      begin + gap, std::min(begin + 0.35 * layout.panel_width(), right - gap - width_of(upper_end, layout.letter())));
  add_text(renderer, "0", x, y, layout.letter(), ink);
  for (int i = 0; i < n_steps; ++i) {
    const double from = begin + i * (end - begin) / n_steps, to = begin + (i + 1) * (end - begin) / n_steps;
    const double middle = y + 0.35 * layout.letter();
    add_lines(renderer, {{{from, middle}, {to, middle}}}, 0.8 * layout.letter(), colour_of_speed((i + 0.5) / n_steps));
  }
  add_fitting_text(renderer, upper_end, end + gap, y, right - end - gap, layout.letter(), ink);
}

// Draws all texts of a picture in a layer behind its panels. At the scale bar, `unit` follows the number. If has_plural is true,
// the unit gets an s after every number except 1.
vtkSmartPointer<vtkRenderer> texts_of_picture(const Layout &layout, const std::vector<PanelTexts> &columns,
                                              const View &view, const Sight &sight, const std::string &unit,
                                              bool has_plural, const Colour &ink) {
  const auto renderer = vtkSmartPointer<vtkRenderer>::New();
  if (!layout.has_scale()) return renderer;
  const int last = layout.n_columns() - 1;
  if (!layout.has_captions()) {
    const double left = layout.column_left(last) + layout.margin(), middle = left + 0.5 * layout.panel_width();
    add_scale_bar(renderer, layout, left, layout.key_line(0), sight, unit, has_plural, ink);
    if (const std::string &upper_end = columns.back().upper_end; !upper_end.empty())
      add_speed_bar(renderer, layout, middle, layout.key_line(0), left + layout.panel_width() - 2 * layout.margin(),
                    upper_end, ink);
    return renderer;
  }
  const double axis = 1.3 * layout.letter();
  add_axes(renderer, layout, layout.margin() + axis, 0.5 * layout.bottom(), axis, view, ink);
  const double first_key = layout.margin() + 4.5 * axis;
  for (int column = 0; column <= last; ++column) {
    const PanelTexts &texts = columns[static_cast<std::size_t>(column)];
    add_caption(renderer, layout, column, texts.caption, ink);
    const double left = column == 0 ? first_key : layout.column_left(column) + layout.margin();
    const double right = layout.column_left(column) + layout.panel_width() - layout.margin();
    if (texts.upper_end.empty())
      add_key(renderer, layout, column, left, column == last ? 1 : 2, texts.key);
    else
      add_speed_bar(renderer, layout, left, layout.key_line(0), right, texts.upper_end, ink);
    if (column == last) add_scale_bar(renderer, layout, left, layout.key_line(1), sight, unit, has_plural, ink);
  }
  return renderer;
}

// Returns the lines of a title, at most two.
std::vector<std::string> lines_of_title(const char *title) {
  const std::string text = title ? title : "Surface";
  const std::size_t end = text.find('\n');
  std::vector<std::string> lines = {drawable(text.substr(0, end))};
  if (end != std::string::npos) lines.push_back(drawable(text.substr(end + 1)));
  return lines;
}

std::vector<KeyEntry> key_of_leaflets(const std::vector<std::string> &names, const SurfacePanel &surface) {
  std::vector<KeyEntry> key;
  for (const vtkIdType leaflet : surface.leaflets()) {
    const bool named = leaflet >= 0 && leaflet < view(names).size();
    key.push_back({named ? view(names)[leaflet] : "leaflet " + std::to_string(leaflet), colour_of_leaflet(leaflet)});
  }
  return key;
}

std::vector<std::string> lines_of_marks(const MarkCounts &marks, const Leaks &leaks) {
  std::vector<std::string> lines = {"Marked: " + grouped(marks.n_marked_nodes) + " of " +
                                    counted(marks.n_nodes, "node")};
  if (leaks.edges) lines.push_back(leaks.n_edges == 0 ? "no leaking edge" : counted(leaks.n_edges, "leaking edge"));
  return lines;
}

std::vector<KeyEntry> key_of_marks(const MarkCounts &marks, const Leaks &leaks, const Colour &ink) {
  std::vector<KeyEntry> key;
  if (marks.n_partly_cells > 0) key.push_back({"pale: cells marked in part", ink});
  if (leaks.edges && leaks.n_edges > 0) key.push_back({"leaking edges", leak_colour});
  return key;
}

KeyEntry dashes_entry(const Colour &ink) { return {"dashed: the mesh goes on", ink}; }

// Returns the texts of a picture with three views: captions and keys, distributed over the columns. Below its other lines, each
// column has the name of its view.
std::vector<PanelTexts> texts_of_columns(const std::vector<PanelTexts> &panels, std::int32_t first) {
  std::vector<PanelTexts> columns(n_views);
  for (std::size_t i = 0; i < panels.size(); ++i) columns[i] = panels[i];
  for (std::int32_t i = 0; i < n_views; ++i) {
    std::vector<std::string> &caption = view(columns)[i].caption;
    caption.resize(2);
    caption.push_back((first == RIIS_VTK_VIEW_VALVE_SIDE ? "valve-" : "") + std::string(view_names[i]));
  }
  return columns;
}

// Computes a picture with transparency from two pictures: one on black and one on white. A pixel that has one colour in both
// pictures is opaque. A pixel that is black in one picture and white in the other is clear. The computation also works for
// blended objects, whatever their order is.
vtkSmartPointer<vtkImageData> transparent_from(vtkImageData *on_black, vtkImageData *on_white) {
  int size[3];
  on_black->GetDimensions(size);
  const auto clear = vtkSmartPointer<vtkImageData>::New();
  clear->SetDimensions(size);
  clear->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  const auto *black = static_cast<const unsigned char *>(on_black->GetScalarPointer());
  const auto *white = static_cast<const unsigned char *>(on_white->GetScalarPointer());
  auto *pixel = static_cast<unsigned char *>(clear->GetScalarPointer());
  for (vtkIdType i = 0; i < clear->GetNumberOfPoints(); ++i, black += 3, white += 3, pixel += 4) {
    int lost = 255;  // how much of the background is lost
    for (int k = 0; k < 3; ++k) lost = std::min(lost, std::max(0, white[k] - black[k]));
    const int opacity = 255 - lost;
    for (int k = 0; k < 3; ++k)
      pixel[k] = static_cast<unsigned char>(opacity == 0 ? 0 : std::min(255, (255 * black[k] + opacity / 2) / opacity));
    pixel[3] = static_cast<unsigned char>(opacity);
  }
  return clear;
}

// Returns the faces of the mesh's boundary. If there is no mesh, returns the faces of the wall in the options, or NULL if there
// is no wall.
vtkSmartPointer<vtkPolyData> wall_of(vtkUnstructuredGrid *grid, const riis_vtk_picture_options &options) {
  if (grid) return outside_of(grid, nullptr, nullptr).faces;
  return options.wall ? polydata_of(options.wall) : nullptr;
}

std::string speed_text(double speed, const std::string &unit) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(3);
  text << speed << ' ' << unit;
  return text.str();
}

int n_panels(const Style &style, bool has_grid) { return has_grid && style.panels == RIIS_VTK_PANELS_BOTH ? 2 : 1; }

}  // namespace

Style::Style(const riis_vtk_picture_options &options)
    : background({options.background[0], options.background[1], options.background[2]}),
      is_transparent(options.background[3] == 0),
      captions(options.captions),
      panels(options.panels) {
  // The shares of red, green and blue in the brightness of a colour on a screen.
  const bool is_bright = 0.2126 * background[0] + 0.7152 * background[1] + 0.0722 * background[2] > 0.4;
  const double of_ink = is_bright ? 0.2 : 0.85, of_line = is_bright ? 0.45 : 0.65;
  ink = {of_ink, of_ink, of_ink};
  line = {of_line, of_line, of_line};
  shell_grey = is_bright ? 0.59 : 0.95;
}

Layout::Layout(int width, int height, int n_panels, Panels panels, std::int32_t captions)
    : width_(width),
      height_(height),
      n_columns_(panels == Panels::stacked ? 1 : n_panels),
      n_rows_(panels == Panels::stacked ? n_panels : 1),
      letter_(std::max(8, std::min(height / 36, width / n_columns_ / 32))) {
  if (height < least_height_with_texts || captions == RIIS_VTK_CAPTIONS_NONE) return;
  const bool has_captions = captions == RIIS_VTK_CAPTIONS_ALL;
  if (has_captions) top_ = (1.6 * (panels == Panels::stacked ? 3 : 2) + 0.6) * letter_;
  bottom_ = (has_captions ? 3.8 : 2.2) * letter_;
}

std::array<double, 4> Layout::viewport(int panel) const {
  const int column = panel % n_columns_, row = panel / n_columns_;
  const double n = n_columns_, above = height_ - top_ - row * panel_height();
  return {column / n, (above - panel_height()) / height_, (column + 1) / n, above / height_};
}

double Layout::line_width() const { return std::max(1.0, height_ / 500.0); }

void check_has_marks(const riis_vtk_mesh *mesh) {
  for (const char *name : {marked_array, distance_array, leaflet_array}) {
    if (!mesh->data->GetPointData()->GetArray(name)) {
      refuse_argument("mesh has no marks: call riis_vtk_mesh_set_marks before riis_vtk_draw");
    }
  }
}

Scene::Scene(vtkUnstructuredGrid *grid, const riis_vtk_picture_options &options, const std::optional<Flow> &flow)
    : style_(options),
      axes_(axes_turned(options.rotation_axis, options.rotation_angle)),
      layout_(options.width, options.height, n_panels(style_, grid), Layout::Panels::side_by_side, options.captions),
      unit_(options.unit ? drawable(options.unit) : ""),
      grid_(grid),
      surface_(layout_.line_width()) {
  for (std::int64_t i = 0; i < options.n_leaflet_names; ++i)
    leaflet_names_.push_back(drawable(options.leaflet_names[i]));
  const vtkSmartPointer<vtkPolyData> wall = wall_of(grid, options);
  if (grid_ && style_.panels != RIIS_VTK_PANELS_VALVE) {
    if (flow)
      flow_.emplace(*flow, wall, style_.ink);
    else
      marks_.emplace(layout_.line_width());
  }
  if (wall) {
    around_ = grid ? static_cast<vtkPointSet *>(grid) : wall.Get();
    // Without captions, no key would explain the dashes, so the shell has no dashes.
    shell_.emplace(wall, style_.shell_grey, style_.line, layout_.line_width(),
                   style_.captions == RIIS_VTK_CAPTIONS_ALL);
  }
  window_->SetOffScreenRendering(1);
  window_->SetMultiSamples(4);
  window_->SetNumberOfLayers(2);
  for (vtkRenderer *renderer : {has_surface() ? surface_.renderer() : nullptr, marks_ ? marks_->renderer() : nullptr,
                                flow_ ? flow_->renderer() : nullptr}) {
    if (!renderer) continue;
    if (shell_ && !(flow_ && renderer == flow_->renderer())) shell_->add_to(renderer);
    renderer->SetLayer(1);
    renderer->SetActiveCamera(camera_);
    window_->AddRenderer(renderer);
  }
}

Scene::~Scene() = default;

void Scene::show(const riis_surface *surface, const char *title, const Leaks &leaks) {
  triangles_ = polydata_of(surface);
  surface_.show(triangles_);
  if (marks_) marks_->show(grid_, leaks.n_edges, leaks.edges);
  texts_.clear();
  const std::vector<KeyEntry> leaflets = key_of_leaflets(leaflet_names_, surface_);
  title_ = lines_of_title(title);
  if (has_surface()) texts_.push_back({title_, leaflets});
  if (!marks_) return;
  PanelTexts marked = {lines_of_marks(marks_->counts(), leaks), key_of_marks(marks_->counts(), leaks, style_.ink)};
  if (!has_surface()) {
    // If a picture has only one panel, this panel has the title and the key of the leaflets.
    std::string line;
    for (const std::string &part : marked.caption) line += (line.empty() ? "" : ", ") + part;
    marked.caption = {title_[0], line};
    marked.key.insert(marked.key.begin(), leaflets.begin(), leaflets.end());
  }
  texts_.push_back(marked);
}

vtkSmartPointer<vtkImageData> Scene::picture(std::int32_t of, const std::optional<Bounds> &seen) {
  if (of == RIIS_VTK_VIEW_THREE) return three_views(RIIS_VTK_VIEW_SIDE, seen);
  if (of == RIIS_VTK_VIEW_VALVE_THREE) return three_views(RIIS_VTK_VIEW_VALVE_SIDE, seen);
  const View view = view_of(of);
  const Sight seen_here = sight(view, seen, layout_);
  std::vector<PanelTexts> texts = texts_for({view});
  if (seen_here.is_cut()) texts.back().key.push_back(dashes_entry(style_.ink));
  return shot(view, seen_here, layout_, texts);
}

View Scene::view_of(std::int32_t of) {
  if (of != RIIS_VTK_VIEW_VALVE_LONG) return {of, axes_};
  if (!long_axes_) long_axes_ = axes_through_two_leaflets(triangles_, axes_);
  return {of, *long_axes_};
}

std::vector<PanelTexts> Scene::texts_for(const std::vector<View> &views) {
  std::vector<PanelTexts> texts = texts_;
  if (!flow_) return texts;
  flow_->show(triangles_, views);
  const std::string length = unit_.empty() ? "mesh unit" : unit_;
  const std::string unit = drawable(flow_->unit().empty() ? length + "/s" : flow_->unit());
  const std::string plane = views.size() == 1 ? "this plane" : "these planes";
  PanelTexts flow;
  const std::string time = flow_->time().empty() ? "" : " at time " + drawable(flow_->time()) + " s";
  const std::string speed = "Speed of the flow" + time,
                    fastest = "fastest in " + plane + ": " + speed_text(flow_->fastest(), unit);
  if (has_surface())
    flow.caption = {speed, fastest};
  else
    flow.caption = {title_[0], speed + ", " + fastest};  // the only panel of a picture has the title
  flow.upper_end = speed_text(flow_->upper_end(), unit);
  texts.push_back(flow);
  return texts;
}

Sight Scene::sight(const View &view, const std::optional<Bounds> &seen, const Layout &layout, double least) const {
  const Extents surface = seen ? view.extents_of(*seen) : view.extents_of(triangles_);
  const Extents mesh = around_ ? view.extents_of(around_) : surface;
  return sight_of(surface, around_ ? &mesh : nullptr, layout.panel_width() / layout.panel_height(), least,
                  flow_ ? reach_of_flow : 1);
}

vtkSmartPointer<vtkImageData> Scene::shot(const View &view, const Sight &sight, const Layout &layout,
                                          const std::vector<PanelTexts> &texts) {
  window_->SetSize(layout.width(), layout.height());
  int n_shown = 0;
  const auto show = [&](auto &panel) {
    const std::array<double, 4> part = layout.viewport(n_shown++);
    panel.renderer()->SetViewport(part[0], part[1], part[2], part[3]);
    panel.look(view, sight);
  };
  aim_camera(camera_, view, sight);
  if (shell_) shell_->look(view, sight);
  if (has_surface()) show(surface_);
  if (marks_) show(*marks_);
  if (flow_) show(*flow_);
  if (behind_) window_->RemoveRenderer(behind_);
  behind_ = texts_of_picture(layout, texts, view, sight, unit_.empty() ? around_ ? "mesh unit" : "unit" : unit_,
                             unit_.empty(), style_.ink);
  window_->AddRenderer(behind_);
  if (has_surface()) surface_.renderer()->ResetCameraClippingRange();
  if (marks_) marks_->renderer()->ResetCameraClippingRange();
  if (flow_) flow_->renderer()->ResetCameraClippingRange();
  if (!style_.is_transparent) return shot_on(style_.background);
  const vtkSmartPointer<vtkImageData> on_black = shot_on({0, 0, 0});
  return transparent_from(on_black, shot_on({1, 1, 1}));
}

vtkSmartPointer<vtkImageData> Scene::shot_on(const Colour &background) {
  behind_->SetBackground(background[0], background[1], background[2]);
  window_->Render();
  return image_of(window_);
}

vtkSmartPointer<vtkImageData> Scene::three_views(std::int32_t first, const std::optional<Bounds> &seen) {
  const int width = layout_.width(), height = layout_.height();
  const Layout column(width / n_views, height, n_panels(style_, grid_), Layout::Panels::stacked, style_.captions);
  double half_height = 0;
  for (std::int32_t of = first; of < first + n_views; ++of)
    half_height = std::max(half_height, sight({of, axes_}, seen, column).shown[1].half());
  std::vector<View> views;
  for (std::int32_t of = first; of < first + n_views; ++of) views.emplace_back(of, axes_);
  const std::vector<PanelTexts> texts = texts_of_columns(texts_for(views), first);
  const auto whole = vtkSmartPointer<vtkImageData>::New();
  whole->SetDimensions(width, height, 1);
  whole->AllocateScalars(VTK_UNSIGNED_CHAR, style_.is_transparent ? 4 : 3);
  for (int k = 0; k < 3; ++k)  // fills pixels beside the views if the width is no multiple of n_views
    whole->GetPointData()->GetScalars()->FillComponent(
        k, style_.is_transparent ? 0 : std::round(255 * style_.background[k]));
  if (style_.is_transparent) whole->GetPointData()->GetScalars()->FillComponent(3, 0);
  for (std::int32_t i = 0; i < n_views; ++i) {
    const View view(first + i, axes_);
    const Sight seen_here = sight(view, seen, column, half_height);
    PanelTexts text = texts[static_cast<std::size_t>(i)];
    if (seen_here.is_cut()) text.key.push_back(dashes_entry(style_.ink));
    const vtkSmartPointer<vtkImageData> part = shot(view, seen_here, column, {text});
    const int left = i * width / n_views;
    part->SetExtent(left, left + column.width() - 1, 0, height - 1, 0, 0);
    whole->CopyAndCastFrom(part, part->GetExtent());
  }
  return whole;
}

}  // namespace riis::vtk
