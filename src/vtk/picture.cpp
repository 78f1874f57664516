// SPDX-License-Identifier: Apache-2.0
// Pictures of riis_vtk.h: a surface and a marked mesh, seen by one camera, to a .png file.
#include <riis/riis_vtk.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include <vtkCamera.h>
#include <vtkErrorCode.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include "vtk/array_names.hpp"
#include "vtk/display.hpp"
#include "vtk/files.hpp"
#include "vtk/mesh.hpp"
#include "vtk/picture_panels.hpp"
#include "vtk/surface_polydata.hpp"
#include "vtk/vtk_errors.hpp"

namespace riis::vtk {
namespace {

using Vector = std::array<double, 3>;

struct View {
  Vector direction, up;  // unit, perpendicular
};

View view_of(int32_t view) {
  if (view == RIIS_VTK_VIEW_SIDE) return {{0, 1, 0}, {0, 0, 1}};
  if (view == RIIS_VTK_VIEW_TOP) return {{0, 0, -1}, {0, 1, 0}};
  View oblique = {{0.35, 0.55, -1.0}, {0, 0, 1}};
  vtkMath::Normalize(oblique.direction.data());
  const double along = oblique.direction[2];
  for (std::size_t k = 0; k < 3; ++k) oblique.up[k] -= along * oblique.direction[k];
  vtkMath::Normalize(oblique.up.data());
  return oblique;
}

struct Extent {
  double lower = std::numeric_limits<double>::max();
  double upper = std::numeric_limits<double>::lowest();
  double middle() const { return 0.5 * lower + 0.5 * upper; }
  double half() const { return 0.5 * (upper - lower); }
};

Extent extent_along(vtkPointSet *data, const Vector &axis) {
  Extent extent;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    double point[3];
    data->GetPoint(i, point);
    const double t = vtkMath::Dot(point, axis.data());
    extent.lower = std::min(extent.lower, t);
    extent.upper = std::max(extent.upper, t);
  }
  return extent;
}

// What the camera fits: the surface; or the mesh around it, where that is not much larger, so that pictures of a valve that
// moves in one mesh can be compared.
vtkPointSet *in_sight(vtkPointSet *surface, vtkPointSet *mesh, const std::array<Vector, 3> &axes) {
  if (!mesh) return surface;
  double surface_size = 0, mesh_size = 0;
  for (const Vector &axis : axes) {
    const Extent inner = extent_along(surface, axis), outer = extent_along(mesh, axis);
    if (outer.lower > inner.lower || outer.upper < inner.upper) return surface;
    surface_size = std::max(surface_size, inner.half());
    mesh_size = std::max(mesh_size, outer.half());
  }
  return mesh_size < 1.5 * surface_size ? mesh : surface;
}

// Without perspective, so that lengths can be compared between panels, and with room for the band and the texts.
void fit_camera(vtkRenderer *renderer, const View &view, vtkPointSet *surface, vtkPointSet *mesh, double aspect) {
  Vector right;
  vtkMath::Cross(view.direction.data(), view.up.data(), right.data());
  vtkPointSet *seen = in_sight(surface, mesh, {right, view.up, view.direction});
  const Extent x = extent_along(seen, right);
  const Extent y = extent_along(seen, view.up);
  const Extent depth = extent_along(seen, view.direction);
  const double size = std::max({x.half(), y.half(), depth.half()});
  Vector focus, eye;
  for (std::size_t k = 0; k < 3; ++k) {
    focus[k] = x.middle() * right[k] + y.middle() * view.up[k] + depth.middle() * view.direction[k];
    eye[k] = focus[k] - 4 * size * view.direction[k];
  }
  vtkCamera *camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(focus.data());
  camera->SetPosition(eye.data());
  camera->SetViewUp(view.up.data());
  camera->SetParallelScale((seen == surface ? 1.3 : 1.15) * std::max(y.half(), x.half() / aspect));
  renderer->ResetCameraClippingRange();
}

void check_options(const riis_vtk_picture_options &options) {
  if (options.struct_size != sizeof options) {
    fail(RIIS_INVALID_STRUCT_SIZE, "options was not filled by riis_vtk_picture_options_init: struct_size " +
                                       std::to_string(options.struct_size) + ", not " + std::to_string(sizeof options));
  }
  if (options.view < RIIS_VTK_VIEW_SIDE || options.view > RIIS_VTK_VIEW_OBLIQUE) {
    fail(RIIS_INVALID_ARGUMENT, "options->view is " + std::to_string(options.view) + ", not a RIIS_VTK_VIEW_*");
  }
  const auto check_pixels = [](const char *name, int32_t n) {
    if (n < 64 || n > 8192) {
      fail(RIIS_INVALID_ARGUMENT, std::string("options->") + name + " is " + std::to_string(n) + ", not 64 to 8192");
    }
  };
  check_pixels("width", options.width);
  check_pixels("height", options.height);
  if (options.n_leaflet_names < 0 || (options.n_leaflet_names > 0 && !options.leaflet_names)) {
    fail(RIIS_INVALID_ARGUMENT, "options->n_leaflet_names is " + std::to_string(options.n_leaflet_names) +
                                    (options.leaflet_names ? "" : ", options->leaflet_names is NULL"));
  }
  for (int64_t i = 0; i < options.n_leaflet_names; ++i) {
    if (!options.leaflet_names[i])
      fail(RIIS_INVALID_ARGUMENT, "options->leaflet_names[" + std::to_string(i) + "] is NULL");
  }
  if (options.reserved != 0) {
    fail(RIIS_INVALID_ARGUMENT, "options->reserved is " + std::to_string(options.reserved) + ", not 0");
  }
}

void check_has_marks(const riis_vtk_mesh *mesh) {
  for (const char *name : {marked_array, distance_array, leaflet_array}) {
    if (!mesh->grid->GetPointData()->GetArray(name)) {
      fail(RIIS_INVALID_ARGUMENT, "mesh has no marks: call riis_vtk_mesh_set_marks before riis_vtk_draw");
    }
  }
}

// VTK knows other letters only as UTF-8, and would take a line break.
std::string drawable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

PanelTexts texts_of(const riis_vtk_picture_options &options, double panel_width) {
  PanelTexts texts{std::max(8, options.height / 36),
                   static_cast<int>(panel_width * options.width),
                   options.title ? drawable(options.title) : "Surface",
                   {}};
  for (int64_t i = 0; i < options.n_leaflet_names; ++i) {
    texts.leaflet_names.push_back(drawable(options.leaflet_names[i]));
  }
  return texts;
}

void write_png(vtkRenderWindow *window, const std::string &path, const CaughtOutput &caught) {
  ReplacingFile file(path);
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  // Into memory, since the PNG library itself prints when a file cannot be written.
  vtkNew<vtkPNGWriter> writer;
  writer->WriteToMemoryOn();
  writer->SetInputConnection(image->GetOutputPort());
  writer->Write();
  caught.check(path);
  vtkUnsignedCharArray *bytes = writer->GetResult();
  if (!bytes || writer->GetErrorCode() != vtkErrorCode::NoError) fail_file(path, "could not be encoded");
  file.write(bytes->GetPointer(0), bytes->GetNumberOfValues());
  file.commit("IEND");
}

void draw(const riis_surface *surface, const riis_vtk_mesh *mesh, const riis_vtk_picture_options &options,
          const std::string &path, const CaughtOutput &caught) {
  if (ending_of(path) != "png") fail_file(path, "the file's ending must be .png");
  const HeldDisplay display;
  const vtkSmartPointer<vtkPolyData> triangles = polydata_of(surface);
  const double panel_width = mesh ? 0.5 : 1.0;
  const PanelTexts texts = texts_of(options, panel_width);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(8);
  window->SetSize(options.width, options.height);
  const auto add = [&](vtkRenderer *renderer, double left) {
    renderer->SetViewport(left, 0, left + panel_width, 1);
    window->AddRenderer(renderer);
    fit_camera(renderer, view_of(options.view), triangles, mesh ? mesh->grid : nullptr,
               panel_width * options.width / options.height);
  };
  add(surface_panel(triangles, texts), 0);
  if (mesh) add(marks_panel(mesh->grid, texts), panel_width);
  window->Render();
  caught.check(path);
  write_png(window, path, caught);
}

}  // namespace
}  // namespace riis::vtk

using namespace riis::vtk;

extern "C" {

RIIS_API riis_status riis_vtk_picture_options_init(riis_vtk_picture_options *options, int64_t struct_size) {
  return guarded([&](const CaughtOutput &) {
    require(options, "options");
    if (struct_size != sizeof *options) {
      fail(RIIS_INVALID_STRUCT_SIZE,
           "struct_size is " + std::to_string(struct_size) + ", not " + std::to_string(sizeof *options));
    }
    *options = {struct_size, RIIS_VTK_VIEW_OBLIQUE, 1600, 800, 0, nullptr, nullptr, 0};
  });
}

RIIS_API riis_status riis_vtk_draw(const riis_surface *surface, const riis_vtk_mesh *mesh,
                                   const riis_vtk_picture_options *options, const char *path) {
  return guarded([&](const CaughtOutput &caught) {
    require(surface, "surface");
    require(path, "path");
    riis_vtk_picture_options used{};
    if (options) {
      used = *options;
    } else {
      check_core(riis_vtk_picture_options_init(&used, sizeof used));
    }
    check_options(used);
    if (mesh) check_has_marks(mesh);
    draw(surface, mesh, used, path, caught);
  });
}

}  // extern "C"
