// SPDX-License-Identifier: Apache-2.0
// riis_closest_*: argument checks around closest points.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "api/handles.hpp"
#include "api/structs.hpp"
#include "base/array_view.hpp"
#include "base/errors.hpp"
#include "geometry/point_triangle.hpp"
#include "parallel/parallel_for.hpp"

using riis::guarded;
using riis::require;

namespace {

// The structs' sizes in the first release.
constexpr std::int64_t closest_size = 96, options_size = 32, arrays_size = 64;

const riis_closest_options default_options{
    sizeof(riis_closest_options), RIIS_AUTO, RIIS_FAR_DISTANCE, 0, 0, nullptr, 0, nullptr};
const riis_closest_arrays default_arrays{
    sizeof(riis_closest_arrays), nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr};

// Writes entry i of the wanted arrays for a point whose closest triangle was found.
void write_closest(const riis_closest_arrays &to, std::int64_t i, const riis::Surface &content, riis::Vec3 p,
                   const riis::ClosestTriangle &found) {
  const riis::TriangleSet &set = content.triangles();
  if (to.distance) to.distance[i] = std::sqrt(found.distance_sq);
  if (to.triangle_id) to.triangle_id[i] = riis::view(set.triangle_id)[found.triangle];
  if (to.leaflet_id) to.leaflet_id[i] = riis::view(set.leaflet_id)[found.triangle];
  const std::array<riis::Vec3, 3> corners = set.corners(found.triangle);
  if (to.normal) riis::put_vector(to.normal, i, riis::triangle_normal(corners));
  if (to.point || to.barycentric || to.side) {
    const riis::PointOnTriangle on = riis::closest_point_on_triangle(p, corners[0], corners[1], corners[2]);
    if (to.point) riis::put_vector(to.point, i, on.point);
    if (to.barycentric) riis::put_vector(to.barycentric, i, {on.barycentric[0], on.barycentric[1], on.barycentric[2]});
    if (to.side)
      to.side[i] = riis::side_of(p - on.point, content.pseudonormals().at(found.triangle, on.barycentric).normal);
  }
}

// Writes entry i for a closest point on the patches. There is no triangle id and no side.
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

// Refuses arrays that need triangles: a caller who gives them means to use them.
void refuse_what_is_of_triangles(const riis_closest_arrays &to, const riis::PatchDistance &method) {
  for (const char *name : {to.barycentric ? "barycentric" : nullptr, to.side ? "side" : nullptr})
    if (name)
      riis::fail(RIIS_INVALID_ARGUMENT, "arrays.", name, " is given, but the surface's distances are by ",
                 method.name(), ": that is of triangles");
}

void write_far(const riis_closest_arrays &to, std::int64_t i, double far_distance) {
  if (to.distance) to.distance[i] = far_distance;
  if (to.triangle_id) to.triangle_id[i] = -1;
  if (to.leaflet_id) to.leaflet_id[i] = -1;
  if (to.side) to.side[i] = 0;
  for (double *vectors : {to.normal, to.point, to.barycentric})
    if (vectors) riis::put_vector(vectors, i, {0, 0, 0});
}

// Returns infinity if the options have no limit.
double limit_of(const riis_closest_options &options) {
  if (options.distance_limit == RIIS_AUTO) return std::numeric_limits<double>::infinity();
  if (!(options.distance_limit >= 0))
    riis::fail(RIIS_INVALID_ARGUMENT, "options.distance_limit is ", options.distance_limit, "; it must be at least 0");
  // Without a limit no point is far, so far_distance does not matter.
  if (std::isfinite(options.distance_limit))
    riis::check_far_distance("options.far_distance", options.far_distance, options.distance_limit);
  return options.distance_limit;
}

// The wanted points: all points, a mask's points, or a list's points.
class WantedPoints {
 public:
  WantedPoints(const riis_closest_options &options, const riis::StridedPoints &points)
      : mask_(options.point_mask), ids_(options.point_ids), n_(points.n) {
    if (!ids_) {
      if (options.n_point_ids != 0)
        riis::fail(RIIS_INVALID_ARGUMENT, "options.n_point_ids is ", options.n_point_ids,
                   ", but options.point_ids is NULL");
      if (n_ > 0) riis::check_points(points, "point", RIIS_INVALID_ARGUMENT);
      return;
    }
    if (mask_) riis::fail(RIIS_INVALID_ARGUMENT, "options.point_ids and options.point_mask are both given");
    if (options.n_point_ids < 0 || options.n_point_ids > points.n)
      riis::fail(RIIS_INVALID_ARGUMENT, "options.n_point_ids is ", options.n_point_ids,
                 "; it must be from 0 to n_points, ", points.n);
    n_ = options.n_point_ids;
    if (n_ == 0) return;
    riis::check_points({0, points.x, points.y, points.z, points.stride}, "point", RIIS_INVALID_ARGUMENT);
    std::int64_t last = -1;
    for (std::int64_t k = 0; k < n_; ++k) {
      const std::int64_t id = ids_[k];
      if (id <= last || id >= points.n)
        riis::fail(RIIS_INVALID_ARGUMENT, "options.point_ids: entry ", k, " is ", id,
                   "; it must be above the entry before, ", last, ", and below n_points, ", points.n);
      riis::check_point(points, id, "point", RIIS_INVALID_ARGUMENT);
      last = id;
    }
  }

  std::int64_t n() const { return n_; }
  // Returns the number of the k-th point.
  std::int64_t id(std::int64_t k) const { return ids_ ? ids_[k] : k; }
  bool is_wanted(std::int64_t id) const { return !mask_ || mask_[id] != 0; }

 private:
  const std::uint8_t *mask_;
  const std::int64_t *ids_;
  std::int64_t n_;
};

}  // namespace

extern "C" {

riis_status riis_closest_point(const riis_surface *surface, const double *point, riis_closest *closest,
                               int64_t struct_size) {
  return guarded([&] {
    const riis::Surface &content = riis::content_of(surface);
    require(point, "point");
    riis::check_points({1, point, point + 1, point + 2, 1}, "point", RIIS_INVALID_ARGUMENT);
    const riis::Vec3 p{point[0], point[1], point[2]};
    const double no_limit = std::numeric_limits<double>::infinity();
    riis_closest answer{};
    const riis_closest_arrays to{sizeof to,     &answer.distance,    answer.point,       answer.barycentric,
                                 answer.normal, &answer.triangle_id, &answer.leaflet_id, &answer.side};
    if (const riis::PatchDistance *method = content.other_distance())
      write_closest(to, 0, *method, method->closest(p, no_limit));
    else
      write_closest(to, 0, content, p, content.scene().closest(p, no_limit));
    riis::write_struct<closest_size>(closest, struct_size, "closest", answer);
  });
}

riis_status riis_closest_options_init(riis_closest_options *options, int64_t struct_size) {
  return guarded([&] { riis::init_struct<options_size>(options, struct_size, "options", default_options); });
}

riis_status riis_closest_arrays_init(riis_closest_arrays *arrays, int64_t struct_size) {
  return guarded([&] { riis::init_struct<arrays_size>(arrays, struct_size, "arrays", default_arrays); });
}

riis_status riis_closest_points(const riis_surface *surface, int64_t n_points, const double *x, const double *y,
                                const double *z, int64_t stride, const riis_closest_options *options,
                                const riis_closest_arrays *arrays) {
  return guarded([&] {
    const riis::Surface &content = riis::content_of(surface);
    const riis_closest_options whole = riis::completed<options_size>(options, "options", default_options);
    const riis_closest_arrays to = riis::completed<arrays_size>(require(arrays, "arrays"), "arrays", default_arrays);
    if (n_points < 0) riis::fail(RIIS_INVALID_ARGUMENT, "n_points is ", n_points, "; it must be at least 0");
    riis::check_threads(whole.n_threads, "options.n_threads");
    if (whole.reserved != 0)
      riis::fail(RIIS_INVALID_ARGUMENT, "options.reserved is ", whole.reserved, "; it must be 0");
    const double limit = limit_of(whole);
    if (const riis::PatchDistance *method = content.other_distance()) refuse_what_is_of_triangles(to, *method);
    const riis::StridedPoints points{n_points, x, y, z, stride};
    const WantedPoints wanted(whole, points);
    if (wanted.n() == 0) return;
    const int n_threads =
        riis::threads_for(whole.n_threads, "options.n_threads", wanted.n(), riis::points_per_thread);

    // If memory runs out here, the arrays are still untouched.
    if (to.side) content.pseudonormals();
    // write_found(i) returns false where nothing is within the limit.
    const auto for_each_point = [&](const auto &write_found) {
      constexpr std::int64_t points_per_block = 512;
      riis::parallel_for_ranges(wanted.n(), points_per_block, n_threads, [&](const riis::Range &range, int) {
        for (std::int64_t k = range.begin; k < range.end; ++k) {
          const std::int64_t i = wanted.id(k);
          if (wanted.is_wanted(i) && !write_found(i)) write_far(to, i, whole.far_distance);
        }
      });
    };
    if (const riis::PatchDistance *method = content.other_distance()) {
      for_each_point([&](std::int64_t i) {
        const riis::ClosestOnPatches found = method->closest(points[i], limit);
        if (found.patch >= 0) write_closest(to, i, *method, found);
        return found.patch >= 0;
      });
    } else {
      for_each_point([&](std::int64_t i) {
        const riis::ClosestTriangle found = content.scene().closest(points[i], limit);
        if (found.triangle >= 0) write_closest(to, i, content, points[i], found);
        return found.triangle >= 0;
      });
    }
  });
}
}
