/* SPDX-License-Identifier: Apache-2.0
 * Records the objects of a test, and makes surfaces that many tests start from. The test owns the objects that functions here
 * return. Include after riis.h and test_support.h. */
#ifndef RIIS_TEST_HANDLES_H
#define RIIS_TEST_HANDLES_H

#include <stddef.h>

#include "calls.h"

/* --- Owned objects: a test's teardown frees them, even after a failed assertion. Each thread has its own list. A thread that the
 * test starts frees its objects by free_owned_after. --- */

typedef struct owned_object {
  void *object;
  void (*destroy)(void *object);
} owned_object;

enum { most_owned = 1000 };
static _Thread_local struct owned_objects {
  owned_object at[most_owned];
  int n, n_of_group;
} owned;

static inline void own_object(void *object, void (*destroy)(void *)) {
  for (int i = 0; i < owned.n; ++i)
    if (owned.at[i].object == object) fail_msg("a test owns an object twice");
  if (owned.n == most_owned) {
    destroy(object);
    fail_msg("a test owns more than %d objects", most_owned);
  }
  owned.at[owned.n++] = (owned_object){object, destroy};
}

static inline int n_owned(void) { return owned.n; }

/* Frees all objects except the first n, in reverse order. */
static inline void free_owned_after(int n) {
  while (owned.n > n) {
    const owned_object last = owned.at[--owned.n];
    last.destroy(last.object);
  }
}

/* Takes an object off the list and returns it. Its `destroy` is NULL if it was not on the list. */
static inline owned_object disown(void *object) {
  int i = owned.n - 1;
  while (i >= 0 && owned.at[i].object != object) --i;
  if (i < 0) return (owned_object){object, NULL};
  const owned_object found = owned.at[i];
  --owned.n;
  memmove(owned.at + i, owned.at + i + 1, (size_t)(owned.n - i) * sizeof *owned.at);
  return found;
}

/* Frees one object before its test ends. NULL is allowed. */
static inline void free_one_owned(void *object) {
  if (!object) return;
  const owned_object found = disown(object);
  if (!found.destroy) fail_msg("the object is not owned");
  found.destroy(object);
}

/* The teardown of a test. */
static inline int free_owned(void **state) {
  (void)state;
  free_owned_after(owned.n_of_group);
  return 0;
}

/* Call this at the end of a group's setup. The objects made so far then last until free_owned_of_group, the group's teardown. */
static inline void keep_owned_for_group(void) { owned.n_of_group = owned.n; }

static inline int free_owned_of_group(void **state) {
  owned.n_of_group = 0;
  return free_owned(state);
}

static inline void *own_memory(void *memory) {
  if (memory) own_object(memory, free);
  return memory;
}

#define DEFINE_OWN(type)                                               \
  static inline void destroy_owned_##type(void *object) {              \
    riis_##type *handle = object;                                      \
    riis_##type##_destroy(&handle);                                    \
  }                                                                    \
  static inline riis_##type *own_##type(riis_##type *handle) {         \
    if (handle) own_object(handle, destroy_owned_##type);              \
    return handle;                                                     \
  }                                                                    \
  static inline void destroy_and_disown_##type(riis_##type **handle) { \
    void *const object = handle ? *handle : NULL;                      \
    riis_##type##_destroy(handle);                                     \
    if (object && !*handle) disown(object);                            \
  }
DEFINE_OWN(valve)
DEFINE_OWN(surface)
DEFINE_OWN(mesh)
DEFINE_OWN(adjacency)
DEFINE_OWN(marks)
DEFINE_OWN(leaks)
DEFINE_OWN(crossings)
DEFINE_OWN(keyframes)
DEFINE_OWN(warp)
#undef DEFINE_OWN

/* A test may destroy an object that it owns. */
#define riis_valve_destroy destroy_and_disown_valve
#define riis_surface_destroy destroy_and_disown_surface
#define riis_mesh_destroy destroy_and_disown_mesh
#define riis_adjacency_destroy destroy_and_disown_adjacency
#define riis_marks_destroy destroy_and_disown_marks
#define riis_leaks_destroy destroy_and_disown_leaks
#define riis_crossings_destroy destroy_and_disown_crossings
#define riis_keyframes_destroy destroy_and_disown_keyframes
#define riis_warp_destroy destroy_and_disown_warp

/* Records its argument, a handle or memory from malloc, and returns it. */
#define own(object) \
  _Generic((object),                       \
      riis_valve *: own_valve,             \
      riis_surface *: own_surface,         \
      riis_mesh *: own_mesh,               \
      riis_adjacency *: own_adjacency,     \
      riis_marks *: own_marks,             \
      riis_leaks *: own_leaks,             \
      riis_crossings *: own_crossings,     \
      riis_keyframes *: own_keyframes,     \
      riis_warp *: own_warp,               \
      void *: own_memory)(object)

/* In a file that includes this header, every test has the teardown. */
#undef cmocka_unit_test
#define cmocka_unit_test(function) cmocka_unit_test_teardown(function, free_owned)

/* --- Surfaces and options --- */

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

/* Returns whether two surfaces have the same information (except times), vertices, triangles and ids, to the last bit. */
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

/* Returns the velocities (3, n_vertices), or NULL unless the last update gave velocities. */
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

/* Makes n random triangles in [-1,1]^3, all with an area: xyz (9 n), ids (3 n). */
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
