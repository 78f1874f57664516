// SPDX-License-Identifier: Apache-2.0
// Calls of riis_surface_* and riis_closest_*.
#include <algorithm>
#include <cmath>

#include "../support/velocity_bound.h"
#include "api_state.hpp"
#include "geometry/point_triangle.hpp"

namespace fuzz {

Closest closest_by_loop(const riis_triangles &t, const std::array<double, 3> &point) {
  const riis::Vec3 p{point[0], point[1], point[2]};
  const auto vertex = [&](std::int64_t id) { return riis::Vec3{t.xyz[3 * id], t.xyz[3 * id + 1], t.xyz[3 * id + 2]}; };
  double best_sq = INFINITY;
  std::int64_t best = -1;
  for (std::int64_t i = 0; i < t.n_triangles; ++i) {
    const std::int64_t *id = t.vertex_id + 3 * i;
    const double sq = riis::closest_point_on_triangle(p, vertex(id[0]), vertex(id[1]), vertex(id[2])).distance_sq;
    if (sq < best_sq) best_sq = sq, best = i;
  }
  return {std::sqrt(best_sq), best};
}

bool is_by_triangles(const riis_surface *surface) {
  const double origin[3] = {0, 0, 0};
  riis_closest closest;
  EXPECT_OK(riis_closest_point(surface, origin, &closest, sizeof closest));
  return closest.triangle_id >= 0;
}

namespace {

riis_surface *&slot_of(Input &in, State &state) { return state.surfaces[in.slot()]; }

riis_surface_options options_of(Input &in) {
  riis_surface_options options = initialised(in, riis_surface_options_init);
  static const double thicknesses[] = {0.5, 0.1, 1, 0.25, RIIS_AUTO, 0.05, 2, 1e-3}, scales[] = {1, 0.01, 100, 0.5};
  options.half_thickness = in.one_in(16) ? in.number() : in.one_of(thicknesses);
  options.tolerance = in.one_in(16) ? in.number() : (1 + in.below(4)) / 4.0;
  if (in.one_in(4)) options.scale = in.one_in(8) ? in.number() : in.one_of(scales);
  if (in.one_in(4))
    for (double &x : options.rotation_axis) x = in.place();
  if (in.one_in(4)) options.rotation_angle = in.number();
  if (in.one_in(4))
    for (double &x : options.translation) x = in.place();
  options.zero_area = in.mostly(in.below(2));
  options.flip_normals = in.mostly(in.below(2));
  if (in.one_in(4)) {
    options.measure = in.mostly(1 + in.below(2));
    if (in.one_in(8)) options.measure_tolerance = in.number();
  }
  if (in.one_in(4)) options.n_threads = in.n_threads();
  if (in.one_in(8)) options.triangulation = in.mostly(in.below(2));
  return options;
}

// A fine sampling of distances would take as long as fine triangles, so this function makes the sampling coarse.
void make_distance_coarse(double size, riis_surface_options &options) {
  if (options.measure == RIIS_MEASURE_TRIANGLES || options.measure_tolerance == RIIS_AUTO) return;
  const double half_thickness = options.half_thickness == RIIS_AUTO ? 0.1 * options.scale : options.half_thickness;
  const double ratio = options.measure_tolerance * half_thickness / options.scale / size;
  if (ratio > 1e-12 && ratio < 0.03) options.measure_tolerance = 1;
}

// Returns an upper bound of the valve's size before its placement.
double size_of(const ValveSlot &slot) {
  if (!slot.handle) return 1;
  double size = 0;
  for (const char *name : {"root_radius", "leaflet_height", "AP_diameter", "ALPM_diameter", "anterior_length",
                           "posterior_scallop_length1", "posterior_scallop_length2", "anterior_horn_height",
                           "posterior_horn_height", "posteromedial_commissure_height", "IT_distance", "indent_depth"}) {
    double value = 0;
    if (riis_valve_get(slot.handle, name, 1, &value) == RIIS_OK) size = std::max(size, std::abs(value));
  }
  return size > 0 ? size : slot.size;
}

// Millions of triangles would waste the fuzzer's time. The tolerance is therefore made coarse, or so fine that the library must
// refuse it.
void make_coarse(Input &in, double size, riis_surface_options &options) {
  const double half_thickness = options.half_thickness == RIIS_AUTO ? 0.1 * options.scale : options.half_thickness;
  const double ratio = options.tolerance * half_thickness / options.scale / size;
  if (!(ratio > 0 && ratio < 0.03) || (ratio < 1e-16 && in.one_in(2))) return;
  options.tolerance = 1;
  options.measure_tolerance = RIIS_AUTO;
  options.half_thickness = 0.03 * size * options.scale;
}

// Returns all data of a surface that can be read, except times.
std::vector<double> picture_of(const riis_surface *surface) {
  riis_surface_info info;
  EXPECT_OK(riis_surface_get_info(surface, &info, sizeof info));
  const riis_triangles t = triangles_of(surface);
  std::vector<double> all = {static_cast<double>(info.n_triangles), info.half_thickness, info.area, info.lower[0],
                             info.upper[2]};
  all.insert(all.end(), t.xyz, t.xyz + 3 * t.n_vertices);
  all.insert(all.end(), t.vertex_id, t.vertex_id + 3 * t.n_triangles);
  return all;
}

// Calls update(surface) if the surface exists, and create(&surface) otherwise.
template <class Create, class Update>
void make(Input &in, State &state, const Create &create, const Update &update) {
  riis_surface *&slot = slot_of(in, state);
  if (slot && in.one_in(2)) {
    const std::vector<double> before = picture_of(slot);
    const Given<riis_surface> surface = given(in, state, State::surface, slot);
    const riis_status status = call(in, [&] { return update(surface.handle); });
    if (!surface.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
    if (status != RIIS_OK)
      EXPECT(before == picture_of(slot), "a refused update changed the surface: %s", riis_last_error());
  } else if (riis_surface *made = made_by<riis_surface>(in, create)) {
    riis_surface_destroy(&slot);
    slot = made;
  }
}

}  // namespace

void make_surface(Input &in, State &state) {
  const ValveSlot &valve_slot = state.valves[in.slot()];
  const Given<riis_valve> valve = given(in, state, State::valve, valve_slot.handle);
  riis_surface_options options = options_of(in);
  make_coarse(in, size_of(valve_slot), options);
  make_distance_coarse(size_of(valve_slot), options);
  make(
      in, state, [&](riis_surface **surface) { return riis_surface_create(valve.handle, &options, surface); },
      [&](riis_surface *surface) { return riis_surface_update(surface, valve.handle, &options); });
}

namespace {

// Returns the velocities of all vertices, or an empty vector if the surface has none.
std::vector<double> velocities_of(const riis_surface *surface) {
  const riis_triangles t = triangles_of(surface);
  return t.velocity ? std::vector<double>(t.velocity, t.velocity + 3 * t.n_vertices) : std::vector<double>();
}

}  // namespace

void move_surface(Input &in, State &state) {
  riis_surface *slot = slot_of(in, state);
  const ValveSlot &valve_slot = state.valves[in.slot()];
  const Given<riis_surface> surface = given(in, state, State::surface, slot);
  const Given<riis_valve> valve = given(in, state, State::valve, valve_slot.handle);
  const Given<riis_valve> before = given(in, state, State::valve, state.valves[in.slot()].handle);
  riis_surface_options options = options_of(in), options_before = options_of(in);
  make_coarse(in, size_of(valve_slot), options);
  make_distance_coarse(size_of(valve_slot), options);
  const double seconds = in.one_in(4) ? in.number() : 0.01;
  const riis_surface_options *how_before = in.one_in(2) ? &options_before : nullptr;
  const std::vector<double> picture = slot ? picture_of(slot) : std::vector<double>();
  const std::vector<double> velocities = slot ? velocities_of(slot) : std::vector<double>();
  const riis_status status = call(in, [&] {
    return riis_surface_update_moving(surface.handle, valve.handle, before.handle, seconds, &options, how_before);
  });
  if (!surface.is_right || !valve.is_right || !before.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) {
    if (slot)
      EXPECT(picture == picture_of(slot) && velocities == velocities_of(slot),
             "a refused update changed the surface: %s", riis_last_error());
    return;
  }
  EXPECT(std::abs(seconds) >= 1e-30 && std::abs(seconds) <= 1e30, "seconds %g", seconds);
  const std::vector<double> made = velocities_of(slot);
  EXPECT(!made.empty(), "no velocities");
  for (const double v : made) EXPECT(std::isfinite(v), "velocity %g", v);
  const double bound = velocity_error_bound(slot, valve.handle, before.handle, seconds, how_before);
  EXPECT(bound >= 0, "bound of the velocities %g", bound);
}

void make_surface_of_arrays(Input &in, State &state) {
  const riis_surface_options options = options_of(in);
  riis_surface_arrays arrays = initialised(in, riis_surface_arrays_init);
  const int n = 1 + in.below(12), n_faces = 1 + in.below(10);
  arrays.n_vertices = n;
  arrays.stride = 1 + in.below(4);
  std::vector<double> xyz(
      static_cast<std::size_t>(arrays.stride >= 3 ? (n - 1) * arrays.stride + 3 : 3 * n * arrays.stride));
  for (double &x : xyz) x = in.place();
  const std::int64_t step = arrays.stride >= 3 ? 1 : n * arrays.stride;
  arrays.x = mostly(in, xyz.data());
  arrays.y = mostly(in, xyz.data() + step);
  arrays.z = mostly(in, xyz.data() + 2 * step);
  arrays.n_faces = n_faces;
  const bool is_64_bits = in.one_in(2);
  arrays.id_bits = is_64_bits ? 64 : 32;
  if (in.one_in(32)) arrays.id_bits = in.one_in(2) ? 16 : -32;
  arrays.index_base = in.mostly(in.below(2));
  arrays.corners_per_face = 3 + in.below(2);
  std::vector<std::int64_t> ids;
  for (std::int64_t i = 0; i < n_faces * arrays.corners_per_face; ++i)
    ids.push_back(in.byte() % n + (arrays.index_base == 1));
  if (in.one_in(16)) ids[static_cast<std::size_t>(in.byte()) % ids.size()] = in.raw<std::int64_t>();
  if (in.one_in(16)) ids[static_cast<std::size_t>(in.byte()) % ids.size()] = n + in.below(2);
  if (in.one_in(32)) arrays.corners_per_face = in.below(3) * 6 - 1;
  const Integers vertex_ids(ids, is_64_bits);
  arrays.vertex_ids = mostly(in, vertex_ids.data());
  std::vector<std::int32_t> leaflets(static_cast<std::size_t>(n_faces));
  for (std::int32_t &leaflet : leaflets) leaflet = in.one_in(32) ? in.raw<std::int32_t>() : in.below(3);
  arrays.leaflet_id = in.one_in(2) ? leaflets.data() : nullptr;
  std::vector<double> velocities(3 * static_cast<std::size_t>(n));
  if (in.one_in(4)) {
    for (double &v : velocities) v = in.place();
    arrays.vx = mostly(in, velocities.data());
    arrays.vy = mostly(in, velocities.data() + 1);
    arrays.vz = mostly(in, velocities.data() + 2);
    arrays.velocity_stride = in.one_in(16) ? -in.below(2) : 3;
  }
  if (in.one_in(8)) {  // vertices without triangles
    arrays.n_faces = 0;
    arrays.vertex_ids = nullptr;
    if (!in.one_in(8)) arrays.leaflet_id = nullptr;
  }
  // The stated sizes may be smaller than the buffers, or impossible.
  if (in.one_in(32)) arrays.n_vertices = in.below(n + 1) - 1;
  if (in.one_in(32)) arrays.n_faces = in.below(n_faces + 1) - 1;
  if (in.one_in(32)) arrays.n_faces = INT64_MAX - in.below(2);
  if (in.one_in(32)) arrays.n_vertices = (std::int64_t{1} << 31) + in.below(2);
  if (in.one_in(32)) arrays.stride = in.one_in(2) ? INT64_MAX : -1;
  const riis_surface_arrays *argument = mostly(in, &arrays);
  const riis_surface_options *how = in.one_in(8) ? nullptr : &options;
  make(
      in, state, [&](riis_surface **surface) { return riis_surface_create_from_arrays(argument, how, surface); },
      [&](riis_surface *surface) { return riis_surface_update_from_arrays(surface, argument, how); });
}

void read_surface(Input &in, State &state) {
  riis_surface *slot = slot_of(in, state);
  const Given<riis_surface> surface = given(in, state, State::surface, slot);
  const auto info = std::make_unique<riis_surface_info>();
  std::memset(static_cast<void *>(info.get()), 0x5a, sizeof *info);
  const std::int64_t size = in.mostly<std::int64_t>(sizeof *info);
  riis_status status = call(in, [&] { return riis_surface_get_info(surface.handle, mostly(in, info.get()), size); });
  if (!surface.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) {
    EXPECT(info->n_triangles == 0x5a5a5a5a5a5a5a5a, "a refused info was written");
  } else {
    EXPECT(info->error_bound >= 0, "%g", info->error_bound);
    const riis_triangles t = triangles_of(surface.handle);
    EXPECT(info->n_triangles == t.n_triangles && info->n_vertices == t.n_vertices && t.n_triangles > 0, "%lld",
           static_cast<long long>(t.n_triangles));
    EXPECT(info->area >= 0, "area %g", info->area);
    EXPECT(info->half_thickness > 0 && info->n_zero_area >= 0, "half thickness %g", info->half_thickness);
    for (std::int64_t i = 0; i < t.n_triangles; ++i) {
      EXPECT(i == 0 || t.triangle_id[i] > t.triangle_id[i - 1], "triangle %lld", static_cast<long long>(i));
      EXPECT(t.leaflet_id[i] >= 0 && t.patch_id[i] >= 0, "triangle %lld", static_cast<long long>(i));
      for (int k = 0; k < 3; ++k) {
        const std::int64_t v = t.vertex_id[3 * i + k];
        EXPECT(v >= 0 && v < t.n_vertices, "triangle %lld", static_cast<long long>(i));
        for (int axis = 0; axis < 3; ++axis)
          EXPECT(t.xyz[3 * v + axis] >= info->lower[axis] && t.xyz[3 * v + axis] <= info->upper[axis],
                 "vertex %lld is out of bounds", static_cast<long long>(v));
      }
    }
  }
  const auto triangles = std::make_unique<riis_triangles>();
  std::memset(static_cast<void *>(triangles.get()), 0x5a, sizeof *triangles);
  const std::int64_t room = in.mostly<std::int64_t>(sizeof *triangles);
  status = call(in, [&] { return riis_surface_get_triangles(surface.handle, mostly(in, triangles.get()), room); });
  if (!surface.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) {
    EXPECT(triangles->n_vertices == 0x5a5a5a5a5a5a5a5a, "refused triangles were written");
    return;
  }
  const double *uv = triangles->uv;
  for (std::int64_t i = 0; uv && i < 2 * triangles->n_vertices; ++i) EXPECT(uv[i] >= 0 && uv[i] <= 1, "uv %g", uv[i]);
}

namespace {

void check_closest(const riis_surface *surface, const std::array<double, 3> &p, const riis_closest &closest) {
  const riis_triangles t = triangles_of(surface);
  if (closest.triangle_id < 0) {
    double sum = 0, normal_sq = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double d = closest.point[axis] - p[static_cast<std::size_t>(axis)];
      sum += d * d;
      normal_sq += closest.normal[axis] * closest.normal[axis];
    }
    EXPECT(std::abs(std::sqrt(sum) - closest.distance) <= 1e-12 * closest.distance, "%g %g", std::sqrt(sum),
           closest.distance);
    EXPECT(normal_sq == 0 || std::abs(normal_sq - 1) < 1e-6, "normal %g", normal_sq);
    EXPECT(closest.triangle_id == -1 && closest.side == 0 && closest.leaflet_id >= 0, "%d", closest.leaflet_id);
    return;
  }
  EXPECT(closest.distance >= 0 && closest.side >= -1 && closest.side <= 1, "%g %d", closest.distance, closest.side);
  double sum = 0;
  for (const double weight : closest.barycentric) {
    EXPECT(weight >= 0 && weight <= 1 + 1e-12, "weight %g", weight);
    sum += weight;
  }
  EXPECT(std::abs(sum - 1) < 1e-9, "weights sum up to %g", sum);
  const double *n = closest.normal;
  EXPECT(std::abs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-6, "normal %g %g %g", n[0], n[1], n[2]);
  if (!is_small(t, 1)) return;
  const Closest expected = closest_by_loop(t, p);
  EXPECT(closest.distance == expected.distance, "distance %.17g, by a loop %.17g", closest.distance, expected.distance);
  EXPECT(closest.triangle_id == t.triangle_id[expected.triangle], "triangle %lld",
         static_cast<long long>(closest.triangle_id));
  EXPECT(closest.leaflet_id == t.leaflet_id[expected.triangle], "leaflet %d", closest.leaflet_id);
}

}  // namespace

void ask_closest_point(Input &in, State &state) {
  riis_surface *slot = slot_of(in, state);
  const Given<riis_surface> surface = given(in, state, State::surface, slot);
  const std::array<double, 3> p = {in.place(), in.place(), in.place()};
  const auto closest = std::make_unique<riis_closest>();
  std::memset(static_cast<void *>(closest.get()), 0x5a, sizeof *closest);
  const std::int64_t size = in.mostly<std::int64_t>(sizeof *closest);
  const riis_status status = call(
      in, [&] { return riis_closest_point(surface.handle, mostly(in, p.data()), mostly(in, closest.get()), size); });
  if (!surface.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status == RIIS_OK)
    check_closest(surface.handle, p, *closest);
  else
    EXPECT(closest->triangle_id == 0x5a5a5a5a5a5a5a5a, "a refused answer was written");
}

void ask_closest_points(Input &in, State &state) {
  riis_surface *slot = slot_of(in, state);
  const Given<riis_surface> surface = given(in, state, State::surface, slot);
  const int n = in.below(9);
  std::vector<double> xyz(static_cast<std::size_t>(3 * std::max(n, 1)));
  for (double &x : xyz) x = in.one_in(32) ? in.place() : in.sound_place();
  riis_closest_options options = initialised(in, riis_closest_options_init);
  options.n_threads = in.n_threads();
  if (in.one_in(2)) options.distance_limit = in.number();
  if (in.one_in(4)) options.far_distance = in.number();
  options.reserved = in.one_in(64) ? 1 : 0;
  const auto size = static_cast<std::size_t>(n);
  std::vector<double> distance(size, -77.5), point(3 * size, -77.5), barycentric(3 * size, -77.5),
      normal(3 * size, -77.5);
  std::vector<std::int64_t> triangle_id(size, -77);
  std::vector<std::int32_t> leaflet_id(size, -77), side(size, -77);
  riis_closest_arrays arrays = initialised(in, riis_closest_arrays_init);
  arrays.distance = distance.data();
  arrays.triangle_id = triangle_id.data();
  if (in.one_in(2)) arrays.point = point.data(), arrays.barycentric = barycentric.data(), arrays.normal = normal.data();
  if (in.one_in(2)) arrays.side = side.data(), arrays.leaflet_id = leaflet_id.data();
  const std::int64_t n_asked = in.one_in(32) ? in.below(n + 1) - 1 : n, stride = in.one_in(32) ? in.below(3) - 2 : 3;
  const double *x = mostly(in, xyz.data());
  const riis_closest_options *how = in.one_in(8) ? nullptr : &options;
  const riis_closest_arrays *to = mostly(in, &arrays);
  const riis_status status = call(in, [&] {
    return closest_points_of(surface.handle, n_asked, x, xyz.data() + 1, xyz.data() + 2, stride, how, to);
  });
  if (!surface.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) {
    for (std::size_t i = 0; i < size; ++i)
      EXPECT(distance[i] == -77.5 && triangle_id[i] == -77, "refused, but written");
    return;
  }
  const double limit = how && options.distance_limit != RIIS_AUTO ? options.distance_limit : INFINITY;
  for (std::size_t i = 0; i < static_cast<std::size_t>(n_asked); ++i) {
    riis_closest one;
    EXPECT_OK(riis_closest_point(surface.handle, xyz.data() + 3 * i, &one, sizeof one));
    const bool is_far = !(one.distance <= limit);
    EXPECT(triangle_id[i] == (is_far ? -1 : one.triangle_id), "point %zu", i);
    if (!is_far) EXPECT(distance[i] == one.distance, "point %zu: %g, alone %g", i, distance[i], one.distance);
    if (arrays.side) EXPECT(side[i] == (is_far ? 0 : one.side), "point %zu: side %d, alone %d", i, side[i], one.side);
  }
}

}  // namespace fuzz
