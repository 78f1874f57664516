// SPDX-License-Identifier: Apache-2.0
// Checks the arguments of riis_closest_*, and searches for closest points.
#include <cmath>
#include <limits>

#include "api/handles.hpp"
#include "api/structs.hpp"
#include "base/errors.hpp"
#include "base/integer_array.hpp"
#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"
#include "search/closest_points.hpp"

using riis::guarded_with_handles;
using riis::require;

namespace {

const riis_closest_options default_closest_options{sizeof(riis_closest_options),
                                                   std::numeric_limits<double>::infinity(),
                                                   RIIS_FAR_DISTANCE,
                                                   nullptr,
                                                   0,
                                                   nullptr,
                                                   0,
                                                   0};
const riis_closest_arrays default_closest_arrays{
    sizeof(riis_closest_arrays), nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr};

// Writes entry i for a closest point on the patches. Points on patches have no triangle id and no side.
void write_closest(const riis_closest_arrays &to, std::int64_t i, const riis::PatchDistance &method,
                   const riis::ClosestOnPatches &found) {
  const riis::PlacedPatch &patch = riis::view(method.patches().patches)[found.patch];
  if (to.distance) to.distance[i] = std::sqrt(found.distance_sq);
  if (to.triangle_id) to.triangle_id[i] = -1;
  if (to.leaflet_id) to.leaflet_id[i] = patch.leaflet_id;
  if (to.side) to.side[i] = 0;
  if (to.point) riis::put_vector(to.point, i, found.point);
  if (to.barycentric) riis::put_vector(to.barycentric, i, {0, 0, 0});
  if (to.normal) riis::put_vector(to.normal, i, patch.normal_at(found.u, found.v));
}

// Refuses an array that only distances to triangles can fill. A caller who passes an array expects values in it.
void refuse_what_is_of_triangles(const riis_closest_arrays &to, const riis::PatchDistance &method) {
  for (const char *name : {to.barycentric ? "barycentric" : nullptr, to.side ? "side" : nullptr})
    if (name)
      riis::fail(RIIS_INVALID_ARGUMENT, "arrays.", name,
                 " is given, but only triangles can fill it, and the surface's distances are by ", method.name());
}

double checked_limit(const riis_closest_options &options) {
  if (!(options.distance_limit >= 0))
    riis::fail(RIIS_INVALID_ARGUMENT, "options.distance_limit is ", options.distance_limit, "; it must be at least 0");
  // Without a limit, no point is too far, so far_distance is not used.
  if (std::isfinite(options.distance_limit))
    riis::check_far_distance("options.far_distance", options.far_distance, options.distance_limit);
  return options.distance_limit;
}

// Checks the options that choose points, and the chosen points.
template <class Points>
riis::WantedPoints checked_points(const riis_closest_options &options, const Points &points) {
  const std::int64_t *const ids = options.point_ids;
  if (!ids) {
    if (options.n_point_ids != 0)
      riis::fail(RIIS_INVALID_ARGUMENT, "options.n_point_ids is ", options.n_point_ids,
                 ", but options.point_ids is NULL");
    riis::WantedPoints all{points.n, options.point_mask};
    if (points.n > 0) all.bounds = riis::check_points(points, "point", RIIS_INVALID_ARGUMENT, "points.");
    return all;
  }
  if (options.point_mask) riis::fail(RIIS_INVALID_ARGUMENT, "options.point_ids and options.point_mask are both given");
  const std::int64_t n = options.n_point_ids;
  if (n < 0 || n > points.n)
    riis::fail(RIIS_INVALID_ARGUMENT, "options.n_point_ids is ", n, "; it must be from 0 to points.n_points, ",
               points.n);
  if (n > 0) riis::check_pointers(points, "point", "points.");
  riis::WantedPoints listed{n, nullptr, ids};
  std::int64_t last = -1;
  for (std::int64_t k = 0; k < n; ++k) {
    const std::int64_t id = ids[k];
    if (id <= last || id >= points.n)
      riis::fail(RIIS_INVALID_ARGUMENT, "options.point_ids: entry ", k, " is ", id,
                 "; it must be above the entry before it, ", last, ", and below points.n_points, ", points.n);
    riis::check_point(points, id, "point", RIIS_INVALID_ARGUMENT);
    listed.bounds.add(points[id]);
    last = id;
  }
  return listed;
}

// Writes the wanted entries of the arrays, for closest points on the patches.
template <class Points>
void find_on_patches(const riis::PatchDistance &method, const riis::ClosestPointsRequest &request, const Points &points,
                     const riis_closest_arrays &to) {
  constexpr std::int64_t points_per_block = 512;
  const riis::WantedPoints &wanted = request.wanted;
  riis::parallel_for_ranges(wanted.n, points_per_block, request.n_threads, [&](const riis::Range &range, int) {
    for (std::int64_t k = range.begin; k < range.end; ++k) {
      const std::int64_t i = wanted.id(k);
      if (!wanted.is_wanted(i)) continue;
      const riis::ClosestOnPatches found = method.closest(points[i], request.limit);
      if (found.patch >= 0)
        write_closest(to, i, method, found);
      else
        riis::write_far(i, request.far_distance, to);
    }
  });
}

// Writes the wanted entries of the arrays. The caller has checked the other options.
template <class Points>
void find_closest(const riis::Surface &content, const Points &points, const riis_closest_options &options, double limit,
                  const riis_closest_arrays &to) {
  const riis::WantedPoints wanted = checked_points(options, points);
  const riis::ClosestPointsRequest request{
      content, wanted, limit, options.far_distance,
      riis::threads_for(options.n_threads, "options.n_threads", wanted.n, riis::points_per_thread)};
  if (const riis::PatchDistance *method = content.other_distance())
    find_on_patches(*method, request, points, to);
  else
    riis::find_closest_points(request, points, to);
}

}  // namespace

extern "C" {

riis_status riis_closest_point(const riis_surface *surface, const double *point, riis_closest *closest,
                               int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis::Surface &content = riis::content_of(surface, false);
    require(point, "point");
    riis::check_points(riis::StridedPoints{1, point, point + 1, point + 2, 1}, "point", RIIS_INVALID_ARGUMENT);
    const riis::Vec3 p{point[0], point[1], point[2]};
    const double no_limit = std::numeric_limits<double>::infinity();
    riis_closest answer{};
    const riis_closest_arrays to{sizeof to,     &answer.distance,    answer.point,       answer.barycentric,
                                 answer.normal, &answer.triangle_id, &answer.leaflet_id, &answer.side};
    if (const riis::PatchDistance *method = content.other_distance())
      write_closest(to, 0, *method, method->closest(p, no_limit));
    else
      riis::write_closest(content, 0, p, content.scene().closest(p, no_limit), to);
    riis::write_struct(closest, struct_size, "closest", answer);
  });
}

RIIS_DEFINE_INIT(riis_closest_options_init, riis_closest_options, options, default_closest_options)

RIIS_DEFINE_INIT(riis_closest_arrays_init, riis_closest_arrays, arrays, default_closest_arrays)

riis_status riis_closest_points(const riis_surface *surface, const riis_points *points,
                                const riis_closest_options *options, const riis_closest_arrays *arrays) {
  return guarded_with_handles([&] {
    const riis::Surface &content = riis::content_of(surface);
    const riis_points from = riis::completed(require(points, "points"), "points", riis::default_points);
    const riis_closest_options whole = riis::completed(options, "options", default_closest_options);
    const riis_closest_arrays to = riis::completed(require(arrays, "arrays"), "arrays", default_closest_arrays);
    if (from.n_points < 0)
      riis::fail(RIIS_INVALID_ARGUMENT, "points.n_points is ", from.n_points, "; it must be at least 0");
    riis::check_bits("points.real_bits", from.real_bits);
    riis::check_reserved("points.reserved", from.reserved);
    riis::check_threads(whole.n_threads, "options.n_threads");
    riis::check_reserved("options.reserved", whole.reserved);
    const double limit = checked_limit(whole);
    if (const riis::PatchDistance *method = content.other_distance()) refuse_what_is_of_triangles(to, *method);
    riis::with_points(from.n_points, {from.x, from.y, from.z}, from.stride, from.real_bits,
                      [&](const auto &given) { find_closest(content, given, whole, limit, to); });
  });
}
}
