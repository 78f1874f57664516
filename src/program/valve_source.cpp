// SPDX-License-Identifier: Apache-2.0
#include "program/valve_source.hpp"

#include <set>
#include <vector>

#include "program/conversion.hpp"
#include "program/motion.hpp"
#include "program/parameters.hpp"
#include "program/progress.hpp"
#include "program/refusal.hpp"
#include "program/valve_file.hpp"

namespace riis::program {
namespace {

void set_parameters(const Options &options, riis_valve *valve) {
  if (!options.params.empty()) set_from_json_file(valve, options.params);
  for (const std::string &setting : options.settings) set_from_text(valve, setting);
  if (options.opening) check(riis_valve_set_scalar(valve, "opening", *options.opening), "--opening");
}

Valve make_valve_of_kind(const Options &options) {
  Valve valve = make_kind(options.valve, "--valve");
  set_parameters(options, valve.get());
  if (!options.params_open.empty()) {
    const Valve open = make_kind(options.valve, "--valve");
    set_from_json_file(open.get(), options.params_open);
    check(riis_valve_set_open_state(valve.get(), open.get()), options.params_open);
  }
  return valve;
}

Valve make_valve_of_file(const Options &options) {
  const Stage stage("reading " + options.valve, options.quiet);
  ValveFile file(options.valve);
  set_parameters(options, file.valve());
  if (!options.print_params && !options.describe_params) file.check_opening();
  return file.take_valve();
}

// Adds to the component's refusal of a file the command that makes a readable one.
void check_read(riis_status status, const std::string &path, Content content) {
  try {
    check(status);
  } catch (Refusal &refusal) {
    if (status == RIIS_FILE_ERROR) refusal.text += conversion_hint(path, content);
    throw;
  }
}

Surface surface_of_valve(const Options &options, const riis_valve *valve) {
  const Stage stage("making the surface", options.quiet);
  riis_surface *surface = nullptr;
  check(riis_surface_create(valve, &options.surface_options, &surface),
        is_valve_file(options.valve) ? options.valve : "");
  return Surface(surface);
}

Surface surface_of_file(const Options &options, const riis_vtk_surface *file, FileVelocity velocity) {
  riis_surface_arrays arrays;
  check(riis_vtk_surface_get_arrays(file, &arrays, sizeof arrays));
  std::vector<double> zeros;
  if (velocity == FileVelocity::zero) {
    zeros.resize(static_cast<std::size_t>(arrays.n_vertices), 0.0);
    arrays.vx = arrays.vy = arrays.vz = zeros.data();
  }
  riis_surface *surface = nullptr;
  check(riis_surface_create_from_arrays(&arrays, &options.surface_options, &surface), options.surface);
  return Surface(surface);
}

}  // namespace

Valve make_kind(const std::string &kind, const std::string &subject) {
  riis_valve *handle = nullptr;
  const riis_status status = riis_valve_create(kind.c_str(), &handle);
  if (status == RIIS_INVALID_PARAMETER) {
    throw Refusal{exit_bad_data, subject + ": " + riis_last_error() + ", and files of patches, FILE.json"};
  }
  check(status);
  return Valve(handle);
}

Valve make_valve(const Options &options) {
  return is_valve_file(options.valve) ? make_valve_of_file(options) : make_valve_of_kind(options);
}

double opening_of(const riis_valve *valve) {
  double opening = 0;
  check(riis_valve_get(valve, "opening", 1, &opening));
  return opening;
}

Valve copy_of(const riis_valve *valve) {
  riis_valve *copy = nullptr;
  check(riis_valve_copy(valve, &copy));
  return Valve(copy);
}

// A valve that is sound at 0 and refused at 1 has one state. What else fails is said where the surface is wanted.
std::string why_closed(riis_valve *valve, const riis_surface_options &how) {
  check(riis_valve_set_scalar(valve, "opening", 1));
  riis_surface *surface = nullptr;
  const riis_status status = riis_surface_create(valve, &how, &surface);
  const Surface owned(surface);
  return status == RIIS_INVALID_PARAMETER ? riis_last_error() : "";
}

void check_mesh_read(riis_status status, const std::string &path) { check_read(status, path, Content::mesh); }

SurfaceFile read_surface(const Options &options, Seconds &seconds) {
  const Stage stage("reading " + options.surface, options.quiet);
  const char *path = options.surface.c_str();
  const bool by_pieces = options.leaflets == "connected";
  riis_vtk_surface *handle = nullptr;
  const char *leaflets = options.leaflets.empty() || by_pieces ? nullptr : options.leaflets.c_str();
  const riis_status status = riis_vtk_surface_read(path, leaflets, &handle);
  check_read(status, options.surface, Content::surface);
  SurfaceFile file(handle);
  if (by_pieces) check(riis_vtk_surface_number_pieces(file.get()));
  seconds.read += stage.seconds();
  return file;
}

Surface make_surface(const ValveSource &source, FileVelocity velocity) {
  if (source.keyframes) return surface_of_keyframes(source.options, source.keyframes.get());
  return source.valve ? surface_of_valve(source.options, source.valve.get())
                      : surface_of_file(source.options, source.file.get(), velocity);
}

int64_t count_leaflets(const riis_surface *surface) {
  const riis_triangles triangles = triangles_of(surface);
  const std::set<int32_t> ids(triangles.leaflet_id, triangles.leaflet_id + triangles.n_triangles);
  return static_cast<int64_t>(ids.size());
}

}  // namespace riis::program
