// SPDX-License-Identifier: Apache-2.0
// Checks the arguments of riis_surface_*. The work is in pipeline/updatable_surface.hpp.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "api/handles.hpp"
#include "api/structs.hpp"
#include "api/surface_options.hpp"
#include "base/errors.hpp"
#include "base/integer_array.hpp"
#include "measures/measures.hpp"
#include "pipeline/updatable_surface.hpp"

using riis::guarded_with_handles;
using riis::require;
using riis::require_handle;

namespace {

const riis_surface_arrays default_surface_arrays{sizeof(riis_surface_arrays),
                                                 0,
                                                 nullptr,
                                                 nullptr,
                                                 nullptr,
                                                 1,
                                                 nullptr,
                                                 nullptr,
                                                 nullptr,
                                                 1,
                                                 0,
                                                 nullptr,
                                                 nullptr,
                                                 3,
                                                 32,
                                                 0,
                                                 64,
                                                 0,
                                                 nullptr,
                                                 nullptr};

// Returns measure_tolerance * half_thickness. If measure_tolerance is RIIS_AUTO, uses tolerance instead.
double distance_error_of(const riis_surface_options &options) {
  return riis::half_thickness_of(options) *
         (options.measure_tolerance == RIIS_AUTO ? options.tolerance : options.measure_tolerance);
}

// Refuses a translation so large that the rounding of the coordinates would flatten the valve.
void check_precision(const riis_surface_options &options, const char *name, double wanted) {
  const double *t = options.translation;
  const double largest = std::max({std::abs(t[0]), std::abs(t[1]), std::abs(t[2])});
  if (largest * std::numeric_limits<double>::epsilon() > 1e-3 * wanted)
    riis::fail(RIIS_INVALID_ARGUMENT, "options.translation moves the valve by ", largest,
               ", where coordinates are rounded by more than a thousandth of ", name, " * half_thickness, ", wanted);
}

// Returns the request. An n_threads of 0 stays 0 in the request, because the surface chooses the number of threads.
riis::SurfaceRequest request_of(const riis_surface_options &options) {
  return {riis::band_of(options), riis::placement_of(options), options.flip_normals != 0, options.n_threads};
}

// The state before a moving update, and the time since then.
struct EarlierArguments {
  const riis_valve *valve_before;
  double dt;
  const riis_surface_options *options_before;
};

riis::EarlierValve earlier_of(const EarlierArguments &given, const riis_surface_options &options_now) {
  // A dt outside of these limits is a mistake of the caller. With a dt within the limits, no velocity comes near overflow.
  if (!(std::abs(given.dt) >= 1e-30 && std::abs(given.dt) <= 1e30))
    riis::fail(RIIS_INVALID_ARGUMENT, "dt is ", given.dt,
               "; it must be the time from valve_before to valve, from 1e-30 to 1e+30 in magnitude");
  const riis_surface_options before = riis::completed(
      given.options_before, "options_before", given.options_before ? riis::default_surface_options : options_now);
  riis::check_placement(before, "options_before");
  return {given.valve_before->valve, riis::placement_of(before), given.dt};
}

void fill_from_valve(riis_surface &surface, const riis_valve *valve, const riis_surface_options &options,
                     const EarlierArguments *earlier = nullptr) {
  riis::check_options(options);
  std::optional<riis::EarlierValve> valve_before;
  if (earlier) valve_before.emplace(earlier_of(*earlier, options));
  const riis::ValveAccuracy accuracy{options.tolerance * riis::half_thickness_of(options), options.measure,
                                     distance_error_of(options), options.triangulation == RIIS_TRIANGULATION_FIXED};
  check_precision(options, "tolerance", accuracy.triangle_error);
  if (options.measure != RIIS_MEASURE_TRIANGLES) check_precision(options, "measure_tolerance", accuracy.distance_error);
  surface.updatable.update_from_valve(valve->valve, valve_before ? &*valve_before : nullptr, request_of(options),
                                      accuracy);
  surface.options = options;
}

// Returns the caller's options. If the caller passes none, returns those of the surface's last update.
riis_surface_options options_for(const riis_surface &surface, const riis_surface_options *options,
                                 const char *name = "options") {
  return riis::completed(options, name, options ? riis::default_surface_options : surface.options);
}

// Checks all handles before it checks the options. `earlier` may be NULL.
void update_from_valve(riis_surface *surface, const riis_valve *valve, const riis_surface_options *options,
                       const EarlierArguments *earlier) {
  require_handle(surface, "surface");
  require_handle(valve, "valve");
  if (earlier) require_handle(earlier->valve_before, "valve_before");
  fill_from_valve(*surface, valve, options_for(*surface, options), earlier);
}

// Each direction keeps 24 bytes for each vertex.
constexpr std::int64_t max_directions = 1000;

void check_can_add_direction(const riis_surface &surface) {
  const riis::Surface &content = surface.updatable.surface();
  if (!content.patches())
    riis::fail(RIIS_INVALID_ARGUMENT,
               "surface was made from arrays, which have no parameters: a direction needs a surface from a valve");
  if (content.n_directions() == max_directions)
    riis::fail(RIIS_LIMIT_EXCEEDED, "surface has ", max_directions, " directions, the largest number");
}

riis_surface_arrays completed(const riis_surface_arrays *arrays) {
  return riis::completed(require(arrays, "arrays"), "arrays", default_surface_arrays);
}

void check_options_for_faces(const riis_surface_options &options) {
  riis::check_options(options);
  if (options.measure != RIIS_MEASURE_TRIANGLES)
    riis::fail(RIIS_INVALID_ARGUMENT, "options.measure is ", options.measure,
               ", which works on patches, but a surface from arrays has triangles only: it must be "
               "RIIS_MEASURE_TRIANGLES, 0");
  if (options.triangulation != RIIS_TRIANGULATION_ADAPTED)
    riis::fail(RIIS_INVALID_ARGUMENT, "options.triangulation is ", options.triangulation,
               ", which is for valves, but a surface from arrays has the caller's triangles: it must be "
               "RIIS_TRIANGULATION_ADAPTED, 0");
}

void fill_from_arrays(riis_surface &surface, const riis_surface_arrays &arrays, const riis_surface_options &options) {
  check_options_for_faces(options);
  surface.updatable.update_from_arrays(arrays, options.zero_area == RIIS_ZERO_AREA_SKIP, request_of(options));
  surface.options = options;
}

void fill_from_keyframes(riis_surface &surface, const riis_keyframes *keyframes, double time, double dt,
                         const riis_surface_options &options) {
  const riis::Keyframes &frames = require_handle(keyframes, "keyframes")->keyframes;
  check_options_for_faces(options);
  surface.updatable.update_from_keyframes(frames, time, dt, options.zero_area == RIIS_ZERO_AREA_SKIP,
                                          request_of(options));
  surface.options = options;
}

template <class Fill>
void create(const riis_surface_options *options, riis_surface **surface, const Fill &fill_surface) {
  require(surface, "surface");
  auto made = std::make_unique<riis_surface>();
  fill_surface(*made, riis::completed(options, "options", riis::default_surface_options));
  *surface = made.release();
}

}  // namespace

extern "C" {

RIIS_DEFINE_INIT(riis_surface_options_init, riis_surface_options, options, riis::default_surface_options)

RIIS_DEFINE_INIT(riis_surface_arrays_init, riis_surface_arrays, arrays, default_surface_arrays)

riis_status riis_surface_create(const riis_valve *valve, const riis_surface_options *options, riis_surface **surface) {
  return guarded_with_handles([&] {
    create(options, surface, [&](riis_surface &made, const riis_surface_options &whole) {
      require_handle(valve, "valve");
      fill_from_valve(made, valve, whole);
    });
  });
}

riis_status riis_surface_create_from_arrays(const riis_surface_arrays *arrays, const riis_surface_options *options,
                                            riis_surface **surface) {
  return guarded_with_handles([&] {
    create(options, surface, [&](riis_surface &made, const riis_surface_options &whole) {
      fill_from_arrays(made, completed(arrays), whole);
    });
  });
}

riis_status riis_surface_update(riis_surface *surface, const riis_valve *valve, const riis_surface_options *options) {
  return guarded_with_handles([&] { update_from_valve(surface, valve, options, nullptr); });
}

riis_status riis_surface_update_moving(riis_surface *surface, const riis_valve *valve, const riis_valve *valve_before,
                                       double dt, const riis_surface_options *options,
                                       const riis_surface_options *options_before) {
  return guarded_with_handles([&] {
    const EarlierArguments earlier{valve_before, dt, options_before};
    update_from_valve(surface, valve, options, &earlier);
  });
}

riis_status riis_surface_add_direction(riis_surface *surface, const riis_valve *valve_after,
                                       const riis_valve *valve_before, double dp,
                                       const riis_surface_options *options_after,
                                       const riis_surface_options *options_before) {
  return guarded_with_handles([&] {
    require_handle(surface, "surface");
    require_handle(valve_after, "valve_after");
    require_handle(valve_before, "valve_before");
    check_can_add_direction(*surface);
    if (!(std::abs(dp) >= 1e-30 && std::abs(dp) <= 1e30))
      riis::fail(RIIS_INVALID_ARGUMENT, "dp is ", dp,
                 "; it must be the parameter's difference from valve_before to valve_after, from 1e-30 to 1e+30 in "
                 "magnitude");
    const auto placement = [&](const riis_surface_options *given, const char *name) {
      const riis_surface_options whole = options_for(*surface, given, name);
      riis::check_placement(whole, name);
      return riis::placement_of(whole);
    };
    const riis::Placement after = placement(options_after, "options_after"),
                          before = placement(options_before, "options_before");
    surface->updatable.add_direction({valve_after->valve, valve_before->valve, after, before, dp},
                                     riis::has_lost_threads() ? 1 : surface->options.n_threads);
  });
}

riis_status riis_surface_get_direction(const riis_surface *surface, int64_t direction_id, riis_direction *direction,
                                       int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis::Surface &content = riis::content_of(surface);
    if (content.n_directions() == 0)
      riis::fail(RIIS_INVALID_ARGUMENT, "direction_id is ", direction_id,
                 ", but the surface has no direction: call riis_surface_add_direction after its last update");
    if (direction_id < 0 || direction_id >= content.n_directions())
      riis::fail(RIIS_INVALID_ARGUMENT, "direction_id is ", direction_id, "; it must be from 0 to ",
                 content.n_directions() - 1);
    riis::write_struct(direction, struct_size, "direction",
                       riis_direction{content.triangles().n_vertices(), content.rates(direction_id).data(),
                                      content.area_rate(direction_id)});
  });
}

riis_status riis_surface_update_from_arrays(riis_surface *surface, const riis_surface_arrays *arrays,
                                            const riis_surface_options *options) {
  return guarded_with_handles([&] {
    require_handle(surface, "surface");
    fill_from_arrays(*surface, completed(arrays), options_for(*surface, options));
  });
}

riis_status riis_surface_create_from_keyframes(const riis_keyframes *keyframes, double time, double dt,
                                               const riis_surface_options *options, riis_surface **surface) {
  return guarded_with_handles([&] {
    create(options, surface, [&](riis_surface &made, const riis_surface_options &whole) {
      fill_from_keyframes(made, keyframes, time, dt, whole);
    });
  });
}

riis_status riis_surface_update_from_keyframes(riis_surface *surface, const riis_keyframes *keyframes, double time,
                                               double dt, const riis_surface_options *options) {
  return guarded_with_handles([&] {
    require_handle(surface, "surface");
    fill_from_keyframes(*surface, keyframes, time, dt, options_for(*surface, options));
  });
}

void riis_surface_destroy(riis_surface **surface) { riis::destroy_handle(surface, "surface"); }

riis_status riis_surface_get_info(const riis_surface *surface, riis_surface_info *info, int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis::Surface &content = riis::content_of(surface);
    const riis::TriangleSet &set = content.triangles();
    const auto &[lower, upper] = content.scene().bounds();
    riis::write_struct(info, struct_size, "info",
                       riis_surface_info{set.n_vertices(),
                                         set.n_triangles(),
                                         set.n_zero_area,
                                         content.half_thickness(),
                                         content.area(),
                                         {lower.x, lower.y, lower.z},
                                         {upper.x, upper.y, upper.z},
                                         surface->updatable.seconds().triangles,
                                         surface->updatable.seconds().scene,
                                         set.error_bound,
                                         content.leaflet_ids().back(),
                                         content.band().offset,
                                         riis::depth_of_contacts(content),
                                         set.skirt,
                                         content.source() ? content.source()->housing : -1});
  });
}

riis_status riis_surface_get_triangles(const riis_surface *surface, riis_triangles *triangles, int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis::TriangleSet &set = riis::content_of(surface).triangles();
    riis::write_struct(
        triangles, struct_size, "triangles",
        riis_triangles{set.n_vertices(), set.xyz.data(), set.uv.empty() ? nullptr : set.uv.data(),
                       set.velocity.empty() ? nullptr : set.velocity.data(), set.n_triangles(), set.vertex_id.data(),
                       set.triangle_id.data(), set.leaflet_id.data(), set.patch_id.data()});
  });
}

riis_status riis_surface_get_attachment(const riis_surface *surface, riis_attachment *attachment, int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis::Surface &content = riis::content_of(surface);
    if (!content.has_attachment())
      riis::fail(RIIS_INVALID_ARGUMENT,
                 "surface was made from arrays without a skirt, so its attached edges are not known: give edges of "
                 "your own, or name the attached vertices by arrays.attached");
    const riis::Attachment &made = content.attachment();
    const auto array = [](const auto &values) { return values.empty() ? nullptr : values.data(); };
    riis::write_struct(attachment, struct_size, "attachment",
                       riis_attachment{made.n_edges(), array(made.edges), array(made.vertex_id), array(made.leaflet_id),
                                       array(made.patch_id)});
  });
}
}
