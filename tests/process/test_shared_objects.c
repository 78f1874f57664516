/* SPDX-License-Identifier: Apache-2.0
 * Threads share new objects. A part of an object is made when a thread first needs it. There are more threads than processors, so
 * the system also interrupts a thread that is making a part. ./run tsan shows whether each part is handed over in an order that
 * every processor keeps. The emulator of ./run arm64 keeps the order of the processor on which it runs, so it cannot show a wrong
 * order. */
#include <omp.h>
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

typedef struct shared_objects {
  riis_valve *valve;
  riis_surface *surface;
  riis_mesh *mesh;
} shared_objects;

static test_mesh nodes;

/* Warps the valve by landmarks around it. The first surface of a warped valve finds where landmarks lie on the curves. */
static void warp_valve(riis_valve *valve) {
  double from[3 * 8], to[3 * 8];
  for (int i = 0; i < 8; ++i)
    for (int c = 0; c < 3; ++c) {
      from[3 * i + c] = i >> c & 1 ? 1.3 : -1.3;
      to[3 * i + c] = 1.03 * from[3 * i + c] + 0.01 * (i * (c + 1) % 3);
    }
  const riis_points sources = points_at(8, from), targets = points_at(8, to);
  riis_warp *warp = NULL;
  CHECK_OK(riis_warp_create(&sources, NULL, &warp));
  own(warp);
  CHECK_OK(riis_warp_set_targets(warp, &targets));
  CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
  free_one_owned(warp);
}

static shared_objects new_objects(void) {
  shared_objects made = {new_valve("aortic"), NULL, NULL};
  made.surface = new_surface(made.valve, NULL);
  warp_valve(made.valve);
  made.mesh = mesh_from(&nodes);
  return made;
}

static uint64_t add_bytes(uint64_t digest, const void *bytes, int64_t n) {
  for (int64_t i = 0; i < n; ++i) digest = (digest ^ ((const unsigned char *)bytes)[i]) * 1099511628211u;
  return digest;
}

/* Calls that make a part of an object. Each call returns a digest of its result, or 0 after an error, and asserts nothing. */
static uint64_t digest_of_marks(const shared_objects *of, int32_t search) {
  riis_mark_options options;
  riis_marks *result = NULL;
  riis_mark_list list;
  uint64_t digest = 0;
  riis_mark_options_init(&options, sizeof options);
  options.search = search;
  options.n_threads = 1;
  options.fields = RIIS_FIELD_SIDE;
  if (riis_marks_create(&result) == RIIS_OK && riis_mark_nodes(of->surface, of->mesh, &options, result) == RIIS_OK &&
      riis_marks_get_list(result, RIIS_LIST_MARKED, &list, sizeof list) == RIIS_OK && list.n_nodes > 0) {
    digest = add_bytes(1, list.node_id, list.n_nodes * (int64_t)sizeof *list.node_id);
    digest = add_bytes(digest, list.distance, list.n_nodes * (int64_t)sizeof *list.distance);
    digest = add_bytes(digest, list.side, list.n_nodes * (int64_t)sizeof *list.side);
  }
  riis_marks_destroy(&result);
  return digest;
}

static uint64_t by_clusters(const shared_objects *of) { return digest_of_marks(of, RIIS_SEARCH_CLUSTERS); }
static uint64_t by_neighbors(const shared_objects *of) { return digest_of_marks(of, RIIS_SEARCH_NEIGHBOR); }

static uint64_t side_of_a_point(const shared_objects *of) {
  const double point[3] = {0.31, -0.23, -0.17};
  riis_closest closest;
  if (riis_closest_point(of->surface, point, &closest, sizeof closest) != RIIS_OK || closest.side == 0) return 0;
  return add_bytes(add_bytes(1, closest.point, sizeof closest.point), &closest.side, sizeof closest.side);
}

static uint64_t attachment(const shared_objects *of) {
  riis_attachment at;
  if (riis_surface_get_attachment(of->surface, &at, sizeof at) != RIIS_OK || at.n_edges == 0) return 0;
  return add_bytes(1, at.edges, 6 * at.n_edges * (int64_t)sizeof *at.edges);
}

static uint64_t area(const shared_objects *of) {
  riis_surface_info info;
  if (riis_surface_get_info(of->surface, &info, sizeof info) != RIIS_OK || info.area <= 0) return 0;
  return add_bytes(1, &info.area, sizeof info.area);
}

static uint64_t orifice(const shared_objects *of) {
  riis_orifice found;
  if (riis_surface_get_orifice(of->surface, NULL, &found, sizeof found) != RIIS_OK || found.area <= 0) return 0;
  return add_bytes(1, &found.area, sizeof found.area);
}

static uint64_t warped_surface(const shared_objects *of) {
  riis_surface *surface = NULL;
  riis_triangles triangles;
  uint64_t digest = 0;
  if (riis_surface_create(of->valve, NULL, &surface) == RIIS_OK &&
      riis_surface_get_triangles(surface, &triangles, sizeof triangles) == RIIS_OK)
    digest = add_bytes(1, triangles.xyz, 3 * triangles.n_vertices * (int64_t)sizeof *triangles.xyz);
  riis_surface_destroy(&surface);
  return digest;
}

static uint64_t (*const calls[])(const shared_objects *) = {by_clusters, by_neighbors, side_of_a_point, attachment,
                                                            area,        orifice,      warped_surface};
enum { n_calls = sizeof calls / sizeof *calls };

TEST(more_threads_than_processors_make_the_parts_of_new_objects) {
  riis_surface *surface = aortic_surface(NULL);
  nodes = lattice_around(surface, 0.2, 0.2);
  const int n_threads = 4 * omp_get_num_procs() < 32 ? 4 * omp_get_num_procs() : 32;
  uint64_t expected[n_calls];
  const shared_objects alone = new_objects();
  for (int i = 0; i < n_calls; ++i) {
    expected[i] = calls[i](&alone);
    assert_true(expected[i] != 0);
  }
  for (int repeat = 0; repeat < trials(10, 400); ++repeat) {
    const int owned_before = n_owned();
    const shared_objects shared = new_objects();
    int n_wrong = 0, n_ran = 0;
#pragma omp parallel num_threads(n_threads) reduction(+ : n_wrong, n_ran)
    {
      /* All threads begin at once. Neighbouring threads begin with different calls, and each repeat starts with another call. */
      const int first = omp_get_thread_num() % 2 ? repeat : repeat + 1 + omp_get_thread_num();
      ++n_ran;
#pragma omp barrier
      for (int i = 0; i < n_calls; ++i)
        n_wrong += calls[(first + i) % n_calls](&shared) != expected[(first + i) % n_calls];
    }
    assert_int_equal(n_wrong, 0);
    assert_int_equal(n_ran, n_threads);
    free_owned_after(owned_before);
  }
}

int main(void) { return run_cases(NULL, NULL); }
