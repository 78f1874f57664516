// SPDX-License-Identifier: Apache-2.0
// Checks the arguments of riis_valve_*. The work is in valve/.
#include "api/handles.hpp"
#include "api/structs.hpp"
#include "api/surface_options.hpp"
#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "measures/measures.hpp"
#include "valve/user_patches.hpp"

using riis::guarded_with_handles;
using riis::require;
using riis::require_handle;

namespace {

const riis_patches default_patches{sizeof(riis_patches), 0, nullptr, nullptr, 0, nullptr, nullptr, nullptr, 0, 0};

}  // namespace

extern "C" {

riis_status riis_valve_create(const char *kind, riis_valve **valve) {
  return guarded_with_handles([&] {
    require(valve, "valve");
    *valve = new riis_valve{{}, riis::Valve(riis::find_valve_kind(require(kind, "kind")))};
  });
}

riis_status riis_valve_copy(const riis_valve *valve, riis_valve **copy) {
  return guarded_with_handles([&] {
    require(copy, "copy");
    *copy = new riis_valve{{}, require_handle(valve, "valve")->valve};
  });
}

void riis_valve_destroy(riis_valve **valve) { riis::destroy_handle(valve, "valve"); }

riis_status riis_valve_set(riis_valve *valve, const char *name, int64_t n_values, const double *values) {
  return guarded_with_handles([&] {
    require_handle(valve, "valve");
    require(name, "name");
    require(values, "values");
    valve->valve.set(name, n_values, values);
  });
}

riis_status riis_valve_set_scalar(riis_valve *valve, const char *name, double value) {
  return riis_valve_set(valve, name, 1, &value);
}

riis_status riis_valve_get(const riis_valve *valve, const char *name, int64_t n_values, double *values) {
  return guarded_with_handles([&] {
    require_handle(valve, "valve");
    require(name, "name");
    require(values, "values");
    valve->valve.get(name, n_values, values);
  });
}

riis_status riis_valve_unset(riis_valve *valve, const char *name) {
  return guarded_with_handles([&] {
    require_handle(valve, "valve");
    valve->valve.unset(require(name, "name"));
  });
}

riis_status riis_valve_is_set(const riis_valve *valve, const char *name, int32_t *is_set) {
  return guarded_with_handles([&] {
    require_handle(valve, "valve");
    require(name, "name");
    require(is_set, "is_set");
    *is_set = valve->valve.is_set(name) ? 1 : 0;
  });
}

riis_status riis_valve_set_open_state(riis_valve *valve, const riis_valve *open) {
  return guarded_with_handles(
      [&] { require_handle(valve, "valve")->valve.set_open_state(require_handle(open, "open")->valve); });
}

riis_status riis_valve_set_skirt_to_wall(riis_valve *valve, const riis_surface *wall, double longest,
                                         const riis_surface_options *options) {
  return guarded_with_handles([&] {
    riis::Valve &content = require_handle(valve, "valve")->valve;
    const riis::Surface &of_wall = require_handle(wall, "wall")->updatable.surface();
    riis::check_range("", "longest", longest, 1e-50, 1e50);
    const riis_surface_options whole = riis::completed(options, "options", riis::default_surface_options);
    riis::check_options(whole);
    if (content.kind().skirt_axis == riis::SkirtAxis::none)
      riis::fail(RIIS_INVALID_PARAMETER, "the ", content.kind().name,
                 " valve has no skirt: its ring closes the gap to the wall; ring_height sets the height of the ring");
    riis::Valve closed = content;
    const double zero = 0;
    closed.set("opening", 1, &zero);
    closed.set("skirt_length", 1, &zero);
    const riis::PatchSet patches = closed.make_patches();
    content.set_skirt_lengths(riis::lengths_to_wall(patches, riis::placement_of(whole),
                                                    {of_wall.triangles(), of_wall.scene()}, longest,
                                                    riis::threads_for(whole.n_threads, 1, 1)));
  });
}

RIIS_DEFINE_INIT(riis_patches_init, riis_patches, patches, default_patches)

riis_status riis_valve_create_from_patches(const riis_patches *patches, riis_valve **valve) {
  return guarded_with_handles([&] {
    require(valve, "valve");
    const riis_patches whole = riis::completed(require(patches, "patches"), "patches", default_patches);
    *valve = new riis_valve{{}, riis::Valve(riis::patches_valve_kind(), riis::patches_from_arrays(whole))};
  });
}

riis_status riis_valve_set_warp(riis_valve *valve, const riis_warp *closed, const riis_warp *open) {
  return guarded_with_handles([&] {
    require_handle(valve, "valve");
    if (open && !closed)
      riis::fail(RIIS_INVALID_ARGUMENT,
                 "open is a warp, but closed is NULL: to use one warp for all openings, pass this warp as closed");
    valve->valve.set_warp(closed ? &require_handle(closed, "closed")->map : nullptr,
                          open ? &require_handle(open, "open")->map : nullptr);
  });
}

riis_status riis_valve_get_patches(riis_valve *valve, riis_valve_patches *patches, int64_t struct_size) {
  return guarded_with_handles([&] {
    require_handle(valve, "valve");
    require(patches, "patches");
    riis::check_struct_size<riis_valve_patches>(struct_size, "patches");
    valve->arrays = riis::arrays_of(valve->valve.make_patches());
    riis::write_struct(patches, struct_size, "patches", riis::view_of(valve->arrays));
  });
}

riis_status riis_valve_get_n_parameters(const riis_valve *valve, int64_t *n_parameters) {
  return guarded_with_handles([&] {
    require_handle(valve, "valve");
    *require(n_parameters, "n_parameters") = riis::view(valve->valve.kind().parameters).size();
  });
}

riis_status riis_valve_get_parameter(const riis_valve *valve, int64_t parameter_id, riis_parameter *parameter,
                                     int64_t struct_size) {
  return guarded_with_handles([&] {
    require_handle(valve, "valve");
    const auto &specs = valve->valve.kind().parameters;
    if (parameter_id < 0 || parameter_id >= riis::view(specs).size())
      riis::fail(RIIS_INVALID_ARGUMENT, "parameter_id is ", parameter_id, "; the ", valve->valve.kind().name,
                 " valve has parameters 0 to ", specs.size() - 1);
    const riis::ParameterSpec &spec = riis::view(specs)[parameter_id];
    const auto &defaults = spec.default_values;
    riis::write_struct(parameter, struct_size, "parameter",
                       riis_parameter{spec.name.c_str(),
                                      spec.unit,
                                      spec.description,
                                      spec.n_values,
                                      {defaults[0], defaults[1], defaults[2]},
                                      spec.minimum,
                                      spec.maximum,
                                      spec.rule.text ? spec.rule.text : "",
                                      spec.other.name ? spec.other.name : "",
                                      spec.other.factor});
  });
}
}
