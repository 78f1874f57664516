// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/picture_options.hpp"

#include <cstring>
#include <string>

#include <vtkUnstructuredGrid.h>

#include "riis_vtk/mesh.hpp"
#include "riis_vtk/vtk_errors.hpp"

namespace riis::vtk {
namespace {

constexpr std::int64_t first_size = 72;  // the struct's size in the first release that had it
constexpr std::int64_t size_here = sizeof(riis_vtk_picture_options);

[[noreturn]] void refuse(const std::string &text) { fail(RIIS_INVALID_ARGUMENT, "options->" + text); }

void check_pixels(const char *name, std::int32_t n) {
  if (n < 64 || n > 8192) refuse(std::string(name) + " is " + std::to_string(n) + ", not 64 to 8192");
}

void check_names(const riis_vtk_picture_options &options) {
  const std::string n = "n_leaflet_names is " + std::to_string(options.n_leaflet_names);
  if (options.n_leaflet_names < 0) refuse(n);
  if (options.n_leaflet_names > 0 && !options.leaflet_names) refuse(n + ", options->leaflet_names is NULL");
  for (std::int64_t i = 0; i < options.n_leaflet_names; ++i) {
    if (!options.leaflet_names[i]) refuse("leaflet_names[" + std::to_string(i) + "] is NULL");
  }
}

void check_edges(const riis_vtk_picture_options &options, const riis_vtk_mesh *mesh) {
  const std::string n = "n_leaking_edges is " + std::to_string(options.n_leaking_edges);
  if (options.n_leaking_edges < 0) refuse(n);
  if (options.n_leaking_edges == 0) return;
  if (!options.leaking_edges) refuse(n + ", options->leaking_edges is NULL");
  if (!mesh) refuse(n + ", and mesh is NULL");
  const std::int64_t n_nodes = mesh->grid->GetNumberOfPoints();
  for (std::int64_t i = 0; i / 2 < options.n_leaking_edges; ++i) {
    const std::int64_t node = options.leaking_edges[i];
    if (node < 0 || node >= n_nodes) {
      refuse("leaking_edges[" + std::to_string(i) + "] is " + std::to_string(node) + "; the mesh has " +
             std::to_string(n_nodes) + " nodes");
    }
  }
}

}  // namespace

void check_picture_options_size(std::int64_t size) { check_struct_size(size, first_size, size_here, "options"); }

const riis_vtk_picture_options &default_picture_options() {
  static const riis_vtk_picture_options defaults = {
      size_here, nullptr, nullptr, 0, nullptr, 0, nullptr, RIIS_VTK_VIEW_OBLIQUE, 1600, 800, 0};
  return defaults;
}

riis_vtk_picture_options completed_picture_options(const riis_vtk_picture_options *options) {
  riis_vtk_picture_options whole = default_picture_options();
  if (options) {
    check_picture_options_size(options->struct_size);
    std::memcpy(&whole, options, static_cast<std::size_t>(options->struct_size));
    whole.struct_size = size_here;
  }
  return whole;
}

void check_view(std::int32_t view, const char *argument) {
  if (view < RIIS_VTK_VIEW_SIDE || view > RIIS_VTK_VIEW_OBLIQUE) {
    fail(RIIS_INVALID_ARGUMENT, std::string(argument) + " is " + std::to_string(view) + ", not a RIIS_VTK_VIEW_*");
  }
}

void check_picture_options(const riis_vtk_picture_options &options, const riis_vtk_mesh *mesh) {
  check_pixels("width", options.width);
  check_pixels("height", options.height);
  check_names(options);
  if (options.reserved != 0) refuse("reserved is " + std::to_string(options.reserved) + ", not 0");
  check_edges(options, mesh);
}

}  // namespace riis::vtk
