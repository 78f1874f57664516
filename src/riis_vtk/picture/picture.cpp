// SPDX-License-Identifier: Apache-2.0
// The functions of riis_vtk.h for pictures. Draws a surface and a marked mesh, as seen by one camera, into .png files. The struct
// with the caller's options may have the size of any release. The caller's options are converted to the struct of this release,
// and then checked. If a check fails, the message names the field and its value.
#include <riis/riis_vtk.h>

#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include <vtkImageData.h>
#include <vtkUnsignedCharArray.h>

#include "common/elementary.hpp"
#include "riis_vtk/base/files.hpp"
#include "riis_vtk/mesh/mesh.hpp"
#include "riis_vtk/picture/drawing.hpp"
#include "riis_vtk/picture/picture_flow.hpp"
#include "riis_vtk/picture/picture_scene.hpp"

namespace riis::vtk {
namespace {

constexpr std::int64_t first_size = 72;  // the struct's size in its first release
constexpr std::int64_t size_here = sizeof(riis_vtk_picture_options);

template <class... Parts>
[[noreturn]] void refuse_option(const Parts &...parts) {
  refuse_argument("options->", parts...);
}

void check_pixels(const char *name, std::int32_t n) {
  if (n < 64 || n > 8192) refuse_option(name, " is ", n, ", not 64 to 8192");
}

void check_names(const riis_vtk_picture_options &options) {
  const std::string n = "n_leaflet_names is " + std::to_string(options.n_leaflet_names);
  if (options.n_leaflet_names < 0) refuse_option(n);
  if (options.n_leaflet_names > 0 && !options.leaflet_names) refuse_option(n, ", options->leaflet_names is NULL");
  for (std::int64_t i = 0; i < options.n_leaflet_names; ++i) {
    if (!options.leaflet_names[i]) refuse_option("leaflet_names[", i, "] is NULL");
  }
}

void check_edges(const riis_vtk_picture_options &options, const riis_vtk_mesh *mesh) {
  const std::string n = "n_leaking_edges is " + std::to_string(options.n_leaking_edges);
  if (options.n_leaking_edges < 0) refuse_option(n);
  if (options.n_leaking_edges == 0) return;
  if (!options.leaking_edges) refuse_option(n, ", options->leaking_edges is NULL");
  if (!mesh) refuse_option(n, ", and mesh is NULL");
  const std::int64_t n_nodes = mesh->n_nodes();
  for (std::int64_t i = 0; i / 2 < options.n_leaking_edges; ++i) {
    const std::int64_t node = options.leaking_edges[i];
    if (node < 0 || node >= n_nodes) {
      refuse_option("leaking_edges[", i, "] is ", node, "; the mesh has ", n_nodes, " nodes");
    }
  }
}

// Fails if check_struct_size does not accept the size of the struct.
void check_picture_options_size(std::int64_t size) { check_struct_size(size, first_size, size_here, "options"); }

const riis_vtk_picture_options &default_picture_options() {
  static const riis_vtk_picture_options defaults = {size_here,
                                                    nullptr,
                                                    nullptr,
                                                    0,
                                                    nullptr,
                                                    0,
                                                    nullptr,
                                                    RIIS_VTK_VIEW_OBLIQUE,
                                                    1600,
                                                    800,
                                                    0,
                                                    {0, 0, 1},
                                                    0,
                                                    nullptr,
                                                    {1, 1, 1, 1},
                                                    RIIS_VTK_CAPTIONS_ALL,
                                                    RIIS_VTK_PANELS_BOTH,
                                                    nullptr};
  return defaults;
}

// Returns the options. An older caller's struct lacks some fields, which get defaults. If `options` is NULL, all fields get
// defaults.
riis_vtk_picture_options completed_picture_options(const riis_vtk_picture_options *options) {
  riis_vtk_picture_options whole = default_picture_options();
  if (options) {
    check_picture_options_size(options->struct_size);
    std::memcpy(&whole, options, static_cast<std::size_t>(options->struct_size));
    whole.struct_size = size_here;
  }
  return whole;
}

// Checks a view. In the message, `argument` is the caller's name for the view.
void check_view(std::int32_t view, const char *argument) {
  if (view < RIIS_VTK_VIEW_SIDE || view > RIIS_VTK_VIEW_VALVE_LONG) {
    refuse_argument(argument, " is ", view, ", not a RIIS_VTK_VIEW_*");
  }
}

// Checks the axes of the valve. The allowed ranges are those of a placement.
void check_rotation(const riis_vtk_picture_options &options) {
  const double *axis = options.rotation_axis;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(std::abs(axis[k]) <= 1e50)) refuse_option("rotation_axis[", k, "] is ", axis[k], ", not -1e50 to 1e50");
  }
  if (hypotenuse(axis[0], axis[1], axis[2]) < 1e-50) {
    refuse_option("rotation_axis is (", axis[0], ", ", axis[1], ", ", axis[2], "), shorter than 1e-50");
  }
  if (!(std::abs(options.rotation_angle) <= 1e6)) {
    refuse_option("rotation_angle is ", options.rotation_angle, ", not -1e6 to 1e6");
  }
}

// Checks the fields that determine the appearance of a picture. `mesh` may be NULL.
void check_style(const riis_vtk_picture_options &options, const riis_vtk_mesh *mesh) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double part = options.background[k];
    if (!(part >= 0 && part <= 1)) refuse_option("background[", k, "] is ", part, ", not 0 to 1");
  }
  const double opacity = options.background[3];
  if (opacity != 0 && opacity != 1) refuse_option("background[3] is ", opacity, ", neither 0 nor 1");
  if (options.captions < RIIS_VTK_CAPTIONS_ALL || options.captions > RIIS_VTK_CAPTIONS_NONE)
    refuse_option("captions is ", options.captions, ", not a RIIS_VTK_CAPTIONS_*");
  if (options.panels < RIIS_VTK_PANELS_BOTH || options.panels > RIIS_VTK_PANELS_MARKS)
    refuse_option("panels is ", options.panels, ", not a RIIS_VTK_PANELS_*");
  if (options.panels == RIIS_VTK_PANELS_MARKS && !mesh)
    refuse_option("panels is RIIS_VTK_PANELS_MARKS, and mesh is NULL");
  if (options.velocity && !mesh) refuse_option("velocity is \"", options.velocity, "\", and mesh is NULL");
}

// Checks all fields except the view. `mesh` may be NULL.
void check_picture_options(const riis_vtk_picture_options &options, const riis_vtk_mesh *mesh) {
  check_pixels("width", options.width);
  check_pixels("height", options.height);
  check_names(options);
  if (options.reserved != 0) refuse_option("reserved is ", options.reserved, ", not 0");
  check_rotation(options);
  check_style(options, mesh);
  check_edges(options, mesh);
}

void check_png(const std::string &path) {
  if (ending_of(path) != "png") fail_file(path, "the file's ending must be .png");
}

// Writes a picture to a file. Fails if VTK reported an error.
void write_png(vtkImageData *image, const std::string &path, const CaughtOutput &caught) {
  caught.check(path);
  ReplacingFile file(path);
  const vtkSmartPointer<vtkUnsignedCharArray> bytes = encoded_png(image);
  caught.check(path);
  if (!bytes) fail_file(path, "could not be encoded");
  file.write(bytes->GetPointer(0), bytes->GetNumberOfValues());
  file.commit("IEND");
}

struct Shot {
  std::int32_t view;
  std::string path;
};

void draw(const riis_surface *surface, const riis_vtk_mesh *mesh, const riis_vtk_picture_options &options,
          const std::vector<Shot> &shots, const CaughtOutput &caught) {
  for (const Shot &shot : shots) check_png(shot.path);
  check_picture_options(options, mesh);
  if (mesh) check_has_marks(mesh);
  if (shots.empty()) return;
  std::optional<Flow> flow;
  if (options.velocity) flow = flow_of(*mesh, options.velocity);
  const HeldDisplay display;
  Scene scene(mesh ? mesh->grid() : nullptr, options, flow);
  scene.show(surface, options.title, {options.n_leaking_edges, options.leaking_edges});
  for (const Shot &shot : shots) write_png(scene.picture(shot.view, std::nullopt), shot.path, caught);
}

Bounds bounds_of(const double *lower, const double *upper) {
  Bounds bounds;
  for (std::size_t k = 0; k < 3; ++k) {
    bounds[k] = {lower[k], upper[k]};
    if (std::isfinite(lower[k]) && std::isfinite(upper[k]) && lower[k] <= upper[k]) continue;
    const std::string place = "[" + std::to_string(k) + "]";
    refuse_argument("lower", place, " is ", lower[k], ", upper", place, " is ", upper[k],
                    "; they must be finite and ascend");
  }
  return bounds;
}

}  // namespace
}  // namespace riis::vtk

struct riis_vtk_film {
  riis::vtk::HeldDisplay display;  // held as long as the scene's window exists
  std::int32_t view;
  riis::vtk::Bounds bounds;
  riis_vtk_mesh mesh;  // shares the grid with the caller's mesh; without a mesh its grid is NULL
  riis::vtk::Scene scene;
};

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
    if (n_views < 0) refuse_argument("n_views is ", n_views);
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

RIIS_API riis_status riis_vtk_film_create(const riis_vtk_mesh *mesh, const double *lower, const double *upper,
                                          const riis_vtk_picture_options *options, riis_vtk_film **film) {
  return guarded([&](const CaughtOutput &) {
    require(lower, "lower");
    require(upper, "upper");
    require(film, "film");
    const riis_vtk_picture_options whole = completed_picture_options(options);
    check_view(whole.view, "options->view");
    check_picture_options(whole, mesh);
    if (whole.velocity) refuse_option("velocity is \"", whole.velocity, "\", which a film does not show");
    const Bounds bounds = bounds_of(lower, upper);
    vtkUnstructuredGrid *grid = mesh ? mesh->grid() : nullptr;
    *film = new riis_vtk_film{{}, whole.view, bounds, {grid}, {grid, whole}};
  });
}

RIIS_API riis_status riis_vtk_film_draw(riis_vtk_film *film, const riis_surface *surface, const char *title,
                                        const char *path) {
  return guarded([&](const CaughtOutput &caught) {
    require(film, "film");
    require(surface, "surface");
    check_png(require(path, "path"));
    if (film->mesh.data) check_has_marks(&film->mesh);
    film->scene.show(surface, title, {});
    write_png(film->scene.picture(film->view, film->bounds), path, caught);
  });
}

RIIS_API void riis_vtk_film_destroy(riis_vtk_film **film) { destroy(film); }

}  // extern "C"
