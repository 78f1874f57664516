// SPDX-License-Identifier: Apache-2.0
#include "figures/picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCleanPolyData.h>
#include <vtkGlyph3D.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>

namespace riis::figures {
namespace {

constexpr double title_height = 36;  // pixels

struct Range {
  double lower = std::numeric_limits<double>::max();
  double upper = std::numeric_limits<double>::lowest();
  double middle() const { return 0.5 * (lower + upper); }
  double half() const { return 0.5 * (upper - lower); }
};

Range range_along(const Points &points, Vec3 axis) {
  Range range;
  for (const Vec3 &p : points) {
    range.lower = std::min(range.lower, dot(p, axis));
    range.upper = std::max(range.upper, dot(p, axis));
  }
  return range;
}

Vec3 unit(Vec3 a) { return (1 / length(a)) * a; }

vtkSmartPointer<vtkPoints> vtk_points(const Points &points) {
  const auto made = vtkSmartPointer<vtkPoints>::New();
  made->SetDataTypeToDouble();
  for (const Vec3 &p : points) made->InsertNextPoint(p.x, p.y, p.z);
  return made;
}

void set_colour(vtkActor *actor, Colour colour) {
  actor->GetMapper()->ScalarVisibilityOff();
  actor->GetProperty()->SetColor(colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
}

// Makes lines and points keep their colour from every direction of view.
void set_unlit(vtkActor *actor) {
  actor->GetProperty()->SetAmbient(1);
  actor->GetProperty()->SetDiffuse(0);
}

}  // namespace

Colour paler(Colour colour, double white) {
  const auto mixed = [&](unsigned char part) {
    return static_cast<unsigned char>(std::lround(part + white * (255 - part)));
  };
  return {mixed(colour.red), mixed(colour.green), mixed(colour.blue)};
}

View looking(Vec3 direction, Vec3 up) {
  const Vec3 along = unit(direction);
  return {along, unit(up - dot(up, along) * along)};
}

Picture::Picture(PictureSize size, const View &view, const Points &to_fit, double margin)
    : size_(size), up_(view.up), direction_(view.direction), renderer_(vtk::white_renderer()) {
  right_ = cross(direction_, up_);
  const Range x = range_along(to_fit, right_), y = range_along(to_fit, up_), z = range_along(to_fit, direction_);
  pixel_ = std::max(2 * x.half() / (size.width - 2 * margin), 2 * y.half() / (size.height - title_height - 2 * margin));
  focus_ = x.middle() * right_ + (y.middle() + 0.5 * title_height * pixel_) * up_ + z.middle() * direction_;
  depth_ = std::max({x.half(), y.half(), z.half()});
  // One lamp is at the eye, the other to the eye's upper left. Parts that face away from both lamps are dim, but not black.
  const double lamps[2][4] = {{0, 0, 1, 0.62}, {-0.6, 0.8, 1, 0.45}};
  for (const auto &[x_of_eye, y_of_eye, z_of_eye, intensity] : lamps) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(x_of_eye, y_of_eye, z_of_eye);
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(intensity);
    renderer_->AddLight(light);
  }
  const Vec3 eye = focus_ - 6 * depth_ * direction_;
  vtkCamera *camera = renderer_->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(focus_.x, focus_.y, focus_.z);
  camera->SetPosition(eye.x, eye.y, eye.z);
  camera->SetViewUp(up_.x, up_.y, up_.z);
  camera->SetParallelScale(0.5 * size.height * pixel_);
}

Vec3 Picture::at_pixel(double x, double y) const {
  return focus_ + pixel_ * (x - 0.5 * size_.width) * right_ + pixel_ * (y - 0.5 * size_.height) * up_;
}

// Moves the point towards the eye. The picture has no perspective, so the point stays at its place in the picture.
Vec3 Picture::raised(Vec3 p, int layer) const { return p - 0.004 * layer * depth_ * direction_; }

vtkSmartPointer<vtkPolyData> Picture::lines(const std::vector<Points> &lines, int layer) const {
  Points all;
  vtkNew<vtkCellArray> cells;
  for (const Points &line : lines) {
    cells->InsertNextCell(static_cast<int>(line.size()));
    for (const Vec3 &p : line) {
      cells->InsertCellPoint(static_cast<vtkIdType>(all.size()));
      all.push_back(raised(p, layer));
    }
  }
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(vtk_points(all));
  data->SetLines(cells);
  return data;
}

void Picture::add_tubes(vtkPolyData *lines, Colour colour, double width) {
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(lines);
  tubes->SetRadius(0.5 * width * pixel_);
  tubes->SetNumberOfSides(12);
  tubes->CappingOn();
  tubes->Update();
  const vtkSmartPointer<vtkActor> actor = vtk::actor_of(tubes->GetOutput());
  set_colour(actor, colour);
  set_unlit(actor);
  renderer_->AddActor(actor);
}

void Picture::add_faces(const Faces &faces, Shading shading) {
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    cells->InsertNextCell(static_cast<vtkIdType>(faces.n_corners),
                          reinterpret_cast<const vtkIdType *>(faces.corners.data() + faces.n_corners * i));
    const Colour &colour = faces.colours[i];
    const unsigned char rgb[3] = {colour.red, colour.green, colour.blue};
    colours->InsertNextTypedTuple(rgb);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(vtk_points(faces.points));
  data->SetPolys(cells);
  data->GetCellData()->SetScalars(colours);
  vtkSmartPointer<vtkPolyData> shown = data;
  if (shading == Shading::smooth || shading == Shading::ghost) {
    // Where patches meet, they have separate points. One common normal hides the seam.
    vtkNew<vtkCleanPolyData> clean;
    clean->SetInputData(data);
    clean->ToleranceIsAbsoluteOn();
    clean->SetAbsoluteTolerance(1e-9);
    clean->ConvertPolysToLinesOff();
    clean->ConvertLinesToPointsOff();
    clean->Update();
    shown = vtk::smoothed(clean->GetOutput());
  }
  const vtkSmartPointer<vtkActor> actor = vtk::coloured_actor_of(shown);
  vtkProperty *property = actor->GetProperty();
  if (shading == Shading::flat) property->SetInterpolationToFlat();
  // The surface emits some light, so that parts that face away from the lamps keep their colour.
  property->SetAmbient(0.52);
  property->SetDiffuse(0.55);
  if (shading == Shading::ghost) {
    property->SetAmbient(0.8);
    property->SetDiffuse(0.3);
    property->SetOpacity(0.2);
  }
  if (shading == Shading::painted) {
    property->SetInterpolationToFlat();
    property->SetAmbient(1);
    property->SetDiffuse(0);
  }
  renderer_->AddActor(actor);
}

void Picture::add_segments(const Segments &segments, Colour colour, double width, int rank) {
  std::vector<Points> all;
  for (const auto &segment : segments) all.push_back({segment[0], segment[1]});
  const vtkSmartPointer<vtkActor> actor = vtk::actor_of(lines(all, 1 + rank));
  set_colour(actor, colour);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  renderer_->AddActor(actor);
}

void Picture::add_curve(const Points &points, Colour colour, double width, int rank) {
  add_tubes(lines({points}, 4 + rank), colour, width);
}

void Picture::add_dashed(const Points &points, Colour colour, double width) {
  const double dash = 11 * pixel_, period = 19 * pixel_;
  std::vector<Points> dashes;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double whole = distance(points[i], points[i + 1]);
    for (double from = 0; from < whole; from += period)
      dashes.push_back({mix(points[i], points[i + 1], from / whole),
                        mix(points[i], points[i + 1], std::min(1.0, (from + dash) / whole))});
  }
  if (!dashes.empty()) add_tubes(lines(dashes, 3), colour, width);
}

void Picture::add_points(const Points &points, Colour colour, double diameter) {
  Points above;
  for (const Vec3 &p : points) above.push_back(raised(p, 8));
  vtkNew<vtkPolyData> data;
  data->SetPoints(vtk_points(above));
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.5 * diameter * pixel_);
  sphere->SetThetaResolution(20);
  sphere->SetPhiResolution(14);
  vtkNew<vtkGlyph3D> spheres;
  spheres->SetInputData(data);
  spheres->SetSourceConnection(sphere->GetOutputPort());
  spheres->ScalingOff();
  spheres->Update();
  const vtkSmartPointer<vtkActor> actor = vtk::actor_of(spheres->GetOutput());
  set_colour(actor, colour);
  actor->GetProperty()->SetAmbient(0.35);
  actor->GetProperty()->SetDiffuse(0.75);
  renderer_->AddActor(actor);
}

void Picture::add_text(double x, double y, const std::string &text, Colour colour, int size, bool is_centred) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->SetPosition(x, y);
  vtkTextProperty *property = actor->GetTextProperty();
  vtk::set_font(property, size);
  property->SetColor(colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
  if (is_centred) property->SetJustificationToCentered();
  property->SetVerticalJustificationToCentered();
  renderer_->AddViewProp(actor);
}

void Picture::add_label(Vec3 at, const std::string &text, double right, double above, Colour colour, int size) {
  const Vec3 from_focus = at - focus_;
  add_text(0.5 * size_.width + dot(from_focus, right_) / pixel_ + right,
           0.5 * size_.height + dot(from_focus, up_) / pixel_ + above, text, colour, size, true);
}

void Picture::add_label_away(Vec3 at, Vec3 from, const std::string &text, double distance, Colour colour, int size) {
  const double x = dot(at - from, right_), y = dot(at - from, up_), size_in_picture = std::hypot(x, y);
  if (size_in_picture > 0)
    add_label(at, text, distance * x / size_in_picture, distance * y / size_in_picture, colour, size);
  else
    add_label(at, text, 0, distance, colour, size);
}

void Picture::add_title(const std::string &text) { add_text(24, size_.height - 32, text, dark, 28, false); }

void Picture::add_scale_and_axes() {
  const auto in_front = [&](Vec3 p) { return p - 4 * depth_ * direction_; };
  const double cm = 1 / pixel_;
  add_tubes(lines({{in_front(at_pixel(28, 30)), in_front(at_pixel(28 + cm, 30))}}, 0), dark, 4);
  add_text(28 + 0.5 * cm, 50, "1 cm", dark, 22, true);
  const Vec3 origin = at_pixel(size_.width - 85, 62);
  const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const char *names[3] = {"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = dot(axes[k], right_), y = dot(axes[k], up_);
    if (std::hypot(x, y) < 0.15) continue;  // the axis points at the eye
    const Vec3 arm = pixel_ * (x * right_ + y * up_);
    add_tubes(lines({{in_front(origin), in_front(origin + 38 * arm)}}, 0), dark, 3);
    add_label_away(origin + 38 * arm, origin, names[k], 17, dark, 24);
  }
}

Png Picture::png() const {
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(8);
  window->SetSize(size_.width, size_.height);
  window->AddRenderer(renderer_);
  renderer_->ResetCameraClippingRange();
  window->Render();
  const vtkSmartPointer<vtkUnsignedCharArray> bytes = vtk::encoded_png(vtk::image_of(window));
  if (!bytes) throw std::runtime_error("a picture could not be encoded");
  Png png{size_.width, size_.height, {}};
  png.bytes.assign(bytes->GetPointer(0), bytes->GetPointer(0) + bytes->GetNumberOfValues());
  window->RemoveRenderer(renderer_);
  return png;
}

}  // namespace riis::figures
