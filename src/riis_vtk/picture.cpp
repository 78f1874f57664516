// SPDX-License-Identifier: Apache-2.0
// Pictures of riis_vtk.h: a surface and a marked mesh, seen by one camera, to .png files.
#include <riis/riis_vtk.h>

#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "riis_vtk/display.hpp"
#include "riis_vtk/drawing.hpp"
#include "riis_vtk/files.hpp"
#include "riis_vtk/mesh.hpp"
#include "riis_vtk/picture_options.hpp"
#include "riis_vtk/picture_scene.hpp"
#include "riis_vtk/picture_texts.hpp"
#include "riis_vtk/vtk_errors.hpp"

namespace riis::vtk {
namespace {

void write_png(vtkRenderWindow *window, const std::string &path, const CaughtOutput &caught) {
  ReplacingFile file(path);
  const vtkSmartPointer<vtkUnsignedCharArray> bytes = encoded_png(window);
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
  for (const Shot &shot : shots) {
    if (ending_of(shot.path) != "png") fail_file(shot.path, "the file's ending must be .png");
  }
  check_picture_options(options, mesh);
  if (mesh) check_has_marks(mesh);
  if (shots.empty()) return;
  const HeldDisplay display;
  Scene scene(mesh ? mesh->grid : nullptr, options);
  scene.show(surface, title_of(options), {options.n_leaking_edges, options.leaking_edges});
  for (const Shot &shot : shots) {
    vtkRenderWindow *window = scene.render(shot.view, std::nullopt);
    caught.check(shot.path);
    write_png(window, shot.path, caught);
  }
}

Bounds bounds_of(const double *lower, const double *upper) {
  Bounds bounds;
  for (std::size_t k = 0; k < 3; ++k) {
    bounds[k] = {lower[k], upper[k]};
    if (std::isfinite(lower[k]) && std::isfinite(upper[k]) && lower[k] <= upper[k]) continue;
    const std::string place = "[" + std::to_string(k) + "]";
    fail(RIIS_INVALID_ARGUMENT, "lower" + place + " is " + joined(lower[k]) + ", upper" + place + " is " +
                                    joined(upper[k]) + "; they must be finite and ascend");
  }
  return bounds;
}

}  // namespace
}  // namespace riis::vtk

struct riis_vtk_film {
  riis::vtk::HeldDisplay display;  // held for as long as the scene's window
  std::int32_t view;
  riis::vtk::Bounds bounds;
  riis_vtk_mesh mesh;  // shares the grid with the caller's mesh; its grid is NULL without one
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

RIIS_API riis_status riis_vtk_film_create(const riis_vtk_mesh *mesh, const double *lower, const double *upper,
                                          const riis_vtk_picture_options *options, riis_vtk_film **film) {
  return guarded([&](const CaughtOutput &) {
    require(lower, "lower");
    require(upper, "upper");
    require(film, "film");
    const riis_vtk_picture_options whole = completed_picture_options(options);
    check_view(whole.view, "options->view");
    check_picture_options(whole, mesh);
    const Bounds bounds = bounds_of(lower, upper);
    vtkUnstructuredGrid *grid = mesh ? mesh->grid.Get() : nullptr;
    *film = new riis_vtk_film{{}, whole.view, bounds, {grid}, {grid, whole}};
  });
}

RIIS_API riis_status riis_vtk_film_draw(riis_vtk_film *film, const riis_surface *surface, const char *title,
                                        const char *path) {
  return guarded([&](const CaughtOutput &caught) {
    require(film, "film");
    require(surface, "surface");
    if (ending_of(require(path, "path")) != "png") fail_file(path, "the file's ending must be .png");
    if (film->mesh.grid) check_has_marks(&film->mesh);
    film->scene.show(surface, title ? drawable(title) : "Surface", {});
    vtkRenderWindow *window = film->scene.render(film->view, film->bounds);
    caught.check(path);
    write_png(window, path, caught);
  });
}

RIIS_API void riis_vtk_film_destroy(riis_vtk_film **film) {
  if (!film) return;
  delete *film;
  *film = nullptr;
}

}  // extern "C"
