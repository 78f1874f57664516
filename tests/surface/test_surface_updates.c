/* SPDX-License-Identifier: Apache-2.0
 * A surface that is updated in its old memory equals a new surface. Content, closest points and marks of both surfaces have the
 * same bits. The equality holds for any earlier content of the surface, and for any number of threads. The equality also holds
 * after updates without a query, and for first queries that several threads make at once. A refused update changes nothing, and
 * its message does not depend on the number of threads. */
#include <pthread.h>
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

static random_source rng;

static int64_t any_of(int64_t n) { return (int64_t)(random_bits(&rng) % (uint64_t)n); }

/* Triangles from arrays. An update moves the triangles, changes their order, or replaces them by other triangles. */
enum { max_triangles = 600 };
static double soup[9 * max_triangles];
static int32_t soup_ids[3 * max_triangles];
static int64_t n_soup;

static void new_soup(int64_t n, double where) {
  double *xyz;
  int32_t *ids;
  random_soup(&rng, n, random_between(&rng, 0.01, 0.5), &xyz, &ids);
  for (int64_t i = 0; i < 9 * n; ++i) soup[i] = where + xyz[i];
  memcpy(soup_ids, ids, 3 * (size_t)n * sizeof *ids);
  n_soup = n;
  free_one_owned(xyz), free_one_owned(ids);
}

static void change_soup(void) {
  const int64_t kind = n_soup ? any_of(5) : 4;
  const double by = pow(10, random_between(&rng, -6, 0));
  for (int64_t i = 0; i < 9 * n_soup && kind < 2; ++i) soup[i] += by * random_between(&rng, -1, 1);
  for (int64_t i = n_soup - 1; i > 0 && kind == 2; --i) /* reorders the same triangles */
    for (int64_t j = any_of(i + 1), k = 0; k < 3; ++k) {
      const int32_t id = soup_ids[3 * i + k];
      soup_ids[3 * i + k] = soup_ids[3 * j + k];
      soup_ids[3 * j + k] = id;
    }
  if (kind == 3) new_soup(n_soup, random_between(&rng, -5, 5));
  if (kind == 4) new_soup(1 + any_of(max_triangles), 0);
}

/* The source of a surface is arrays, patches or a valve. */
typedef struct content {
  riis_valve *valve; /* or a valve */
  riis_surface_arrays arrays;
  riis_surface_options options;
} content;

static riis_status make_any(const content *c, riis_surface **surface) {
  if (!c->valve)
    return *surface ? riis_surface_update_from_arrays(*surface, &c->arrays, &c->options)
                    : riis_surface_create_from_arrays(&c->arrays, &c->options, surface);
  return *surface ? riis_surface_update(*surface, c->valve, &c->options)
                  : riis_surface_create(c->valve, &c->options, surface);
}

static riis_status make(const content *c, riis_surface **surface) {
  const int is_new = !*surface;
  const riis_status status = make_any(c, surface);
  if (is_new) own(*surface);
  return status;
}

static content random_content(riis_valve *const *valves) {
  content c = {NULL, {0}, surface_options()};
  const int64_t kind = any_of(8);
  if (random_bits(&rng) & 1) c.options.translation[0] = random_between(&rng, -3, 3);
  c.options.flip_normals = any_of(4) == 0;
  if (kind < 4) {
    c.valve = valves[kind / 2];
    CHECK_OK(riis_valve_set_scalar(c.valve, "opening", random_between(&rng, 0, 1)));
    if (any_of(4) == 0) c.options.tolerance = 1;
    if (any_of(8) == 0) c.options.tolerance = 0.01;
    if (any_of(6) == 0) c.options.measure = RIIS_MEASURE_SAMPLING, c.options.measure_tolerance = 0.2;
    /* A tolerance may be so fine that it is refused. */
    if (any_of(6) == 0) c.options.tolerance = c.options.half_thickness = 1e-5;
  } else {
    change_soup();
    static int32_t ids[3 * max_triangles];
    memcpy(ids, soup_ids, 3 * (size_t)n_soup * sizeof *ids);
    const int64_t without_area = any_of(6) ? -1 : any_of(n_soup);
    if (without_area >= 0) ids[3 * without_area] = ids[3 * without_area + 1];
    c.arrays = triangle_arrays(3 * n_soup, soup, n_soup, ids);
    c.options.zero_area = random_bits(&rng) & 1;
  }
  return c;
}

enum { n_points = 30, n_callers = 3 };

/* A thread of the caller, which queries closest points one by one. */
typedef struct caller {
  const riis_surface *surface;
  const double *points;
  pthread_barrier_t *all_here;
  riis_closest closest[n_points];
  int n_failed;
} caller;

static void *query_all(void *argument) {
  caller *own = argument;
  pthread_barrier_wait(own->all_here);
  for (int i = 0; i < n_points; ++i)
    own->n_failed +=
        riis_closest_point(own->surface, own->points + 3 * i, own->closest + i, sizeof *own->closest) != RIIS_OK;
  return NULL;
}

/* Checks that closest points have the same bits. Some query points are at vertices, where pseudonormals decide the sides. Several
 * threads begin at once, and any of them may build the tree. */
static void check_closest(const riis_surface *updated, const riis_surface *fresh) {
  const riis_triangles all = triangles_of(fresh);
  double points[3 * n_points];
  for (int i = 0; i < n_points; ++i) {
    const double *vertex = all.xyz + 3 * all.vertex_id[any_of(3 * all.n_triangles)];
    const double off = i % 3 ? pow(10, random_between(&rng, -3, 1)) : 1e-3;
    for (int c = 0; c < 3; ++c) points[3 * i + c] = vertex[c] + off * random_between(&rng, -1, 1);
  }
  static caller callers[n_callers];
  pthread_t threads[n_callers];
  pthread_barrier_t all_here;
  pthread_barrier_init(&all_here, NULL, n_callers);
  for (int k = 0; k < n_callers; ++k) {
    callers[k] = (caller){.surface = updated, .points = points, .all_here = &all_here};
    assert_int_equal(pthread_create(threads + k, NULL, query_all, callers + k), 0);
  }
  for (int k = 0; k < n_callers; ++k) pthread_join(threads[k], NULL);
  pthread_barrier_destroy(&all_here);
  for (int k = 0; k < n_callers; ++k) {
    assert_int_equal(callers[k].n_failed, 0);
    for (int i = 0; i < n_points; ++i) {
      const riis_closest expected = closest_to(fresh, points[3 * i], points[3 * i + 1], points[3 * i + 2]);
      assert_memory_equal(callers[k].closest + i, &expected, sizeof expected);
    }
  }
}

static void check_marks(const riis_surface *updated, const riis_surface *fresh, riis_marks *result) {
  const int owned_before = n_owned();
  enum { n = 600 };
  static double xyz[3 * n];
  const riis_triangles all = triangles_of(fresh);
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c)
      xyz[3 * i + c] = all.xyz[3 * all.vertex_id[3 * (i % all.n_triangles)] + c] + 0.3 * random_between(&rng, -1, 1);
  riis_marks *expected = new_result();
  riis_mark_options options = mark_options();
  riis_mesh *mesh = mesh_of(n, xyz);
  options.search = RIIS_SEARCH_EXHAUSTIVE;
  options.distance_limit = 0.15;
  CHECK_OK(riis_mark_nodes(fresh, mesh, &options, expected));
  CHECK_OK(riis_mark_nodes(updated, mesh, &options, result));
  assert_true(same_results(result, expected));
  options.search = RIIS_SEARCH_CLUSTERS;
  /* Surfaces that measure distances by sampling refuse the search over clusters. */
  if (riis_mark_nodes(updated, mesh, &options, result) == RIIS_OK) assert_true(same_results(result, expected));
  free_owned_after(owned_before);
}

TEST(an_updated_surface_is_a_fresh_one) {
  riis_valve *valves[2] = {new_valve("aortic"), new_valve("mitral")}, *open = new_valve("aortic");
  /* `last` is a new surface with the content that `updated` should have. */
  riis_surface *updated = NULL, *last = NULL;
  riis_marks *result = new_result();
  CHECK_OK(riis_valve_set_scalar(open, "leaflet_angle", 40));
  CHECK_OK(riis_valve_set_open_state(valves[0], open));
  int n_updates = 0, n_refused = 0;
  for (int step = 0; step < 160; ++step) {
    static const int32_t threads[] = {0, 1, 2, 3, 7};
    content c = random_content(valves);
    riis_surface *fresh = NULL;
    char text[512];
    c.options.n_threads = 1;
    const riis_status expected = make(&c, &fresh);
    if (expected) snprintf(text, sizeof text, "%s", riis_last_error());
    c.options.n_threads = threads[any_of(5)];
    assert_int_equal(make(&c, &updated), expected);
    if (expected) {
      assert_string_equal(riis_last_error(), text);
      ++n_refused;
      if (!last) continue;
    } else {
      ++n_updates;
      free_one_owned(last);
      last = fresh;
    }
    assert_true(is_same_content(updated, last));
    if (any_of(4) == 0) continue; /* the next update then follows an update without a query */
    check_closest(updated, last);
    check_marks(updated, last, result);
  }
  printf("%d updates, %d refused\n", n_updates, n_refused);
  assert_true(n_updates > 80 && n_refused > 5);
}

int main(void) {
  rng = random_start("test_surface_updates");
  return run_cases(NULL, NULL);
}
