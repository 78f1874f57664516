// SPDX-License-Identifier: Apache-2.0
// Checks the arguments of riis_warp_*, and converts between the caller's coordinates and the valve's. The work is in
// valve/warp.hpp.
#include <array>
#include <limits>
#include <utility>

#include "api/handles.hpp"
#include "api/structs.hpp"
#include "api/surface_options.hpp"
#include "base/errors.hpp"
#include "base/integer_array.hpp"
#include "geometry/strided.hpp"
#include "laws/key_times.hpp"

using riis::guarded_with_handles;
using riis::require;
using riis::require_handle;
using riis::Vec3;

namespace {

const riis_warp_options default_warp_options{sizeof(riis_warp_options), 0, nullptr};
constexpr std::int64_t max_landmarks = 1000;

Vec3 to_valve(const riis::Placement &placement, Vec3 p) {
  const riis::Rotation &turn = placement.rotation;
  const Vec3 d = p - placement.translation;
  return (1 / placement.scale) * (d.x * turn.row_x + d.y * turn.row_y + d.z * turn.row_z);
}

// Converts the caller's points to the valve's coordinates, and calls take(i, point) for each point.
template <class Take>
void for_each_point(const riis_points *given, const char *name, const char *prefix, const riis::Placement &placement,
                    std::int64_t wanted, const Take &take) {
  const riis_points whole = riis::completed(require(given, name), name, riis::default_points);
  if (whole.real_bits != 32 && whole.real_bits != 64)
    riis::fail(RIIS_INVALID_ARGUMENT, name, ".real_bits is ", whole.real_bits, "; it must be 32 or 64");
  if (whole.reserved != 0) riis::fail(RIIS_INVALID_ARGUMENT, name, ".reserved is ", whole.reserved, "; it must be 0");
  if (whole.n_points < 0 || whole.n_points > (std::int64_t{1} << 40))
    riis::fail(RIIS_INVALID_ARGUMENT, name, ".n_points is ", whole.n_points, "; it must be from 0 to 2^40");
  if (wanted >= 0 && whole.n_points != wanted)
    riis::fail(RIIS_INVALID_ARGUMENT, name, ".n_points is ", whole.n_points, ", but the warp has ", wanted,
               " landmarks");
  riis::with_points(
      whole.n_points, {whole.x, whole.y, whole.z}, whole.stride, whole.real_bits, [&](const auto &points) {
        riis::check_points(points, wanted >= 0 || wanted == -2 ? "landmark" : "point", RIIS_INVALID_ARGUMENT, prefix);
        for (std::int64_t i = 0; i < points.n; ++i) take(i, to_valve(placement, points[i]));
      });
}

riis::Vector<Vec3> &room_for_targets(riis_warp &warp) {
  warp.targets.clear();
  warp.targets.reserve(warp.landmarks.size());
  return warp.targets;
}

// Fits a new map to the warp's targets. If the new map does not fold, it replaces the present map.
void fit(riis_warp &warp) {
  riis::WarpQuality quality{};
  warp.landmarks.fit(warp.targets, warp.next_map, quality);
  if (!(quality.least_determinant > 0)) {
    const Vec3 p = riis::place(warp.placement, quality.least_point);
    riis::fail(RIIS_INVALID_PARAMETER, "the warp folds near landmark ", quality.least_landmark, ": its determinant is ",
               quality.least_determinant, " at (", p.x, ", ", p.y, ", ", p.z,
               "), among the sources; it must be above 0");
  }
  std::swap(warp.map, warp.next_map);
  warp.quality = quality;
}

}  // namespace

extern "C" {

RIIS_DEFINE_INIT(riis_warp_options_init, riis_warp_options, options, default_warp_options)

riis_status riis_warp_create(const riis_points *sources, const riis_warp_options *options, riis_warp **warp) {
  return guarded_with_handles([&] {
    require(warp, "warp");
    const riis_warp_options whole = riis::completed(options, "options", default_warp_options);
    riis::check_range("options", "noise", whole.noise, 0, 1e50);
    riis::Placement placement{1, riis::no_rotation, {0, 0, 0}};
    if (whole.placement) {
      const riis_surface_options placed =
          riis::completed(whole.placement, "options.placement", riis::default_surface_options);
      riis::check_placement(placed, "options.placement");
      placement = riis::placement_of(placed);
    }
    const std::int64_t n = require(sources, "sources")->n_points;
    if (n < 3 || n > max_landmarks)
      riis::fail(RIIS_INVALID_ARGUMENT, "sources.n_points is ", n, "; it must be from 3 to ", max_landmarks);
    riis::Vector<Vec3> places;
    for_each_point(sources, "sources", "sources.", placement, -2, [&](std::int64_t, Vec3 p) { places.push_back(p); });
    auto made =
        std::make_unique<riis_warp>(riis::WarpLandmarks(places, whole.noise / placement.scale, "sources"), placement);
    made->targets = places;
    fit(*made);
    *warp = made.release();
  });
}

void riis_warp_destroy(riis_warp **warp) { riis::destroy_handle(warp, "warp"); }

riis_status riis_warp_set_targets(riis_warp *warp, const riis_points *targets) {
  return guarded_with_handles([&] {
    require_handle(warp, "warp");
    riis::Vector<Vec3> &places = room_for_targets(*warp);
    for_each_point(targets, "targets", "targets.", warp->placement, static_cast<std::int64_t>(warp->landmarks.size()),
                   [&](std::int64_t, Vec3 p) { places.push_back(p); });
    fit(*warp);
  });
}

riis_status riis_warp_set_targets_at(riis_warp *warp, const riis_keyframe_arrays *frames, double time) {
  return guarded_with_handles([&] {
    require_handle(warp, "warp");
    riis_keyframe_arrays defaults;
    riis_keyframe_arrays_init(&defaults, sizeof defaults);
    const riis_keyframe_arrays whole = riis::completed(require(frames, "frames"), "frames", defaults);
    const auto n = static_cast<std::int64_t>(warp->landmarks.size());
    riis::check_bits("frames.real_bits", whole.real_bits);
    if (whole.n_vertices != n)
      riis::fail(RIIS_INVALID_ARGUMENT, "frames.n_vertices is ", whole.n_vertices, ", but the warp has ", n,
                 " landmarks");
    const riis::KeyTimes keys("frames", whole.n_keys, whole.time, whole.period, whole.interpolation);
    require(whole.xyz, "frames.xyz");
    const auto coordinate = [&](std::int64_t key, std::int64_t i) {
      const std::int64_t at = key * 3 * n + i;
      const double x = whole.real_bits == 32 ? static_cast<double>(static_cast<const float *>(whole.xyz)[at])
                                             : static_cast<const double *>(whole.xyz)[at];
      if (!riis::is_usable(x))
        riis::fail(RIIS_INVALID_ARGUMENT, "xyz"[i % 3], " of landmark ", i / 3, " in frame ", key, " is ", x,
                   "; it must be finite and at most ", riis::max_coordinate, " in magnitude");
      return x;
    };
    if (keys.is_closed())
      for (std::int64_t i = 0; i < 3 * n; ++i)
        if (coordinate(0, i) != coordinate(whole.n_keys - 1, i))
          riis::fail(RIIS_INVALID_ARGUMENT, "landmark ", i / 3,
                     " in the last frame, one period after the first frame, has the ", "xyz"[i % 3], " ",
                     coordinate(whole.n_keys - 1, i), "; it must equal that of the first frame, ", coordinate(0, i));
    const riis::KeyTimes::KeysAround around = keys.around(time);
    riis::Vector<Vec3> &places = room_for_targets(*warp);
    for (std::int64_t i = 0; i < n; ++i) {
      double p[3];
      for (int axis = 0; axis < 3; ++axis) {
        std::array<double, 4> values;
        for (std::size_t k = 0; k < 4; ++k) values[k] = coordinate(around.key[k], 3 * i + axis);
        p[axis] = keys.between(around, values).value;
      }
      places.push_back(to_valve(warp->placement, {p[0], p[1], p[2]}));
    }
    fit(*warp);
  });
}

riis_status riis_warp_get_info(const riis_warp *warp, riis_warp_info *info, int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis_warp &given = *require_handle(warp, "warp");
    const riis::WarpQuality &quality = given.quality;
    const double scale = given.placement.scale;
    const Vec3 p = riis::place(given.placement, quality.least_point);
    riis::write_struct(info, struct_size, "info",
                       riis_warp_info{static_cast<std::int64_t>(given.landmarks.size()),
                                      scale * quality.rms_residual,
                                      scale * quality.largest_residual,
                                      quality.largest_landmark,
                                      quality.smoothing,
                                      quality.least_determinant,
                                      {p.x, p.y, p.z},
                                      given.landmarks.is_planar() ? 1 : 0,
                                      0});
  });
}

riis_status riis_warp_map(const riis_warp *warp, const riis_points *points, double *mapped) {
  return guarded_with_handles([&] {
    const riis_warp &given = *require_handle(warp, "warp");
    if (require(points, "points")->n_points > 0) require(mapped, "mapped");
    for_each_point(points, "points", "points.", given.placement, -1, [&](std::int64_t i, Vec3 p) {
      riis::put_vector(mapped, i, riis::place(given.placement, given.map.value(p)));
    });
  });
}
}
