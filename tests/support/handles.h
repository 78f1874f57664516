/* SPDX-License-Identifier: Apache-2.0
 * Makes surfaces that many tests start from. Objects that these functions return belong to the test (owned.h). Include after
 * riis.h and test_support.h. */
#ifndef RIIS_TEST_HANDLES_H
#define RIIS_TEST_HANDLES_H

#include <stddef.h>

#include "calls.h"
#include "owned.h"

static inline riis_surface_options surface_options(void) {
  riis_surface_options options;
  CHECK_OK(riis_surface_options_init(&options, sizeof options));
  return options;
}

static inline riis_mark_options mark_options(void) {
  riis_mark_options options;
  CHECK_OK(riis_mark_options_init(&options, sizeof options));
  return options;
}

static inline riis_valve *new_valve(const char *kind) {
  riis_valve *valve = NULL;
  CHECK_OK(riis_valve_create(kind, &valve));
  return own(valve);
}

/* Makes the surface of a valve. options may be NULL. */
static inline riis_surface *new_surface(const riis_valve *valve, const riis_surface_options *options) {
  riis_surface *surface = NULL;
  CHECK_OK(riis_surface_create(valve, options, &surface));
  return own(surface);
}

/* Makes the surface of the default valve of a kind. options may be NULL. */
static inline riis_surface *surface_of_kind(const char *kind, const riis_surface_options *options) {
  riis_valve *valve = new_valve(kind);
  riis_surface *surface = new_surface(valve, options);
  free_one_owned(valve);
  return surface;
}

/* Makes the surface of the default aortic valve. options may be NULL. */
static inline riis_surface *aortic_surface(const riis_surface_options *options) {
  return surface_of_kind("aortic", options);
}

/* Describes triangles from arrays: xyz(3, n_vertices), ids(3, n_triangles). */
static inline riis_surface_arrays triangle_arrays(int64_t n_vertices, const double *xyz, int64_t n_triangles,
                                                  const int32_t *ids) {
  riis_surface_arrays arrays;
  CHECK_OK(riis_surface_arrays_init(&arrays, sizeof arrays));
  arrays.n_vertices = n_vertices;
  arrays.x = xyz;
  arrays.y = xyz + 1;
  arrays.z = xyz + 2;
  arrays.stride = 3;
  arrays.n_faces = n_triangles;
  arrays.vertex_ids = ids;
  return arrays;
}

static inline riis_surface *surface_from(const riis_surface_arrays *arrays, const riis_surface_options *options) {
  riis_surface *surface = NULL;
  CHECK_OK(riis_surface_create_from_arrays(arrays, options, &surface));
  return own(surface);
}

/* Makes a mesh that borrows the coordinates, (3, n). */
static inline riis_mesh *mesh_of(int64_t n, const double *xyz) {
  riis_mesh *mesh = NULL;
  CHECK_OK(riis_mesh_create(n, xyz, xyz + 1, xyz + 2, 3, &mesh));
  return own(mesh);
}

static inline riis_surface_info info_of(const riis_surface *surface) {
  riis_surface_info info;
  CHECK_OK(riis_surface_get_info(surface, &info, sizeof info));
  return info;
}

/* Returns whether two surfaces have the same vertices, triangles, ids and information, bit for bit. Times may differ. */
static inline int is_same_content(const riis_surface *a, const riis_surface *b) {
  const riis_triangles s = triangles_of(a), t = triangles_of(b);
  const riis_surface_info of_a = info_of(a), of_b = info_of(b);
  const size_t n = (size_t)s.n_triangles;
  return memcmp(&of_a, &of_b, offsetof(riis_surface_info, seconds_triangles)) == 0 &&
         memcmp(s.xyz, t.xyz, (size_t)s.n_vertices * 3 * sizeof *s.xyz) == 0 && !s.uv == !t.uv &&
         (!s.uv || memcmp(s.uv, t.uv, (size_t)s.n_vertices * 2 * sizeof *s.uv) == 0) &&
         memcmp(s.vertex_id, t.vertex_id, 3 * n * sizeof *s.vertex_id) == 0 &&
         memcmp(s.triangle_id, t.triangle_id, n * sizeof *s.triangle_id) == 0 &&
         memcmp(s.leaflet_id, t.leaflet_id, n * sizeof *s.leaflet_id) == 0 &&
         memcmp(s.patch_id, t.patch_id, n * sizeof *s.patch_id) == 0;
}

/* Returns the velocities (3, n_vertices), or NULL if the last update gave none. */
static inline const double *velocity_of(const riis_surface *surface) { return triangles_of(surface).velocity; }

static inline riis_closest closest_to(const riis_surface *surface, double x, double y, double z) {
  const double point[3] = {x, y, z};
  riis_closest closest;
  CHECK_OK(riis_closest_point(surface, point, &closest, sizeof closest));
  return closest;
}

/* Describes n points xyz (3, n). The array must outlive the description. */
static inline riis_points points_at(int64_t n, const double *xyz) {
  riis_points points;
  CHECK_OK(riis_points_init(&points, sizeof points));
  points.n_points = n;
  points.x = xyz, points.y = xyz + 1, points.z = xyz + 2;
  points.stride = 3;
  return points;
}

/* Makes n random triangles in [-1,1]^3 with xyz (9 n) and ids (3 n). Each triangle has a positive area. */
static inline void random_soup(random_source *random, int64_t n, double size, double **xyz, int32_t **ids) {
  *xyz = own(malloc((size_t)n * 9 * sizeof **xyz));
  *ids = own(malloc((size_t)n * 3 * sizeof **ids));
  for (int64_t i = 0; i < n; ++i) {
    double centre[3];
    for (int c = 0; c < 3; ++c) centre[c] = random_between(random, -1, 1);
    for (int k = 0; k < 9; ++k) (*xyz)[9 * i + k] = centre[k % 3] + size * random_between(random, -1, 1);
    for (int k = 0; k < 3; ++k) (*ids)[3 * i + k] = (int32_t)(3 * i + k);
  }
}

#endif
