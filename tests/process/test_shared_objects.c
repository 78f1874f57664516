/* SPDX-License-Identifier: Apache-2.0
 * Threads share new objects. A part of an object is made when a thread first needs it. There are more threads than processors, so
 * the system also interrupts a thread that is making a part. ./run tsan shows whether each part is handed over in an order that
 * every processor keeps. The emulator of ./run arm64 keeps the order of the processor on which it runs, so it cannot show a wrong
 * order. */
#include <omp.h>
#include <riis/riis.h>
#include <sched.h>
#include <stdatomic.h>
#include <sys/wait.h>
#include <unistd.h>

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

/* A log function that holds a call of the second thread until the first thread has made its own calls. */
static atomic_int n_waiting, may_go_on;

static void hold(void *user_data, int32_t level, const char *message) {
  (void)user_data, (void)level, (void)message;
  if (omp_get_thread_num() == 0 || atomic_load(&may_go_on)) return;
  atomic_store(&n_waiting, 1);
  while (!atomic_load(&may_go_on)) sched_yield();
}

/* Runs call(of) on a second thread. Runs meanwhile(of) on this thread while the log function holds the call. */
static void while_held(void (*call)(const shared_objects *), void (*meanwhile)(const shared_objects *),
                       const shared_objects *of) {
  atomic_store(&n_waiting, 0), atomic_store(&may_go_on, 0);
  riis_set_log(hold, NULL);
#pragma omp parallel num_threads(2)
  {
    if (omp_get_thread_num() == 0) {
      while (!atomic_load(&n_waiting)) sched_yield();
      meanwhile(of);
      atomic_store(&may_go_on, 1);
    } else {
      call(of);
    }
  }
  riis_set_log(NULL, NULL);
}

static riis_marks *shared_marks;
static riis_status status_of_call;

static void update_surface(const shared_objects *of) {
  status_of_call = riis_surface_update(of->surface, of->valve, NULL);
}

static void use_what_is_updated(const shared_objects *of) {
  static const double origin[3] = {0, 0, 0};
  riis_closest closest;
  riis_surface *surface = of->surface, *other = NULL;
  riis_surface_info info;
#define IS_HELD(name, call) CHECK_REFUSED(RIIS_UNAVAILABLE, name " is in use by another thread: while a call", call)
  IS_HELD("surface", riis_surface_update(surface, of->valve, NULL));
  IS_HELD("surface", riis_mark_nodes(surface, of->mesh, NULL, shared_marks));
  IS_HELD("surface", riis_closest_point(surface, origin, &closest, sizeof closest));
  IS_HELD("surface", riis_surface_get_info(surface, &info, sizeof info));
  IS_HELD("valve", riis_valve_set_scalar(of->valve, "opening", 1));
  riis_surface_destroy(&surface);
  assert_non_null(surface);
  CHECK_OK(riis_surface_create(of->valve, NULL, &other)); /* two calls may read the valve */
  riis_surface_destroy(&other);
}

static void mark(const shared_objects *of) {
  status_of_call = riis_mark_nodes(of->surface, of->mesh, NULL, shared_marks);
}

static void use_what_is_marked(const shared_objects *of) {
  static const double origin[3] = {0, 0, 0};
  riis_closest closest;
  riis_mark_list list;
  riis_marks *other = NULL;
  IS_HELD("marks", riis_mark_nodes(of->surface, of->mesh, NULL, shared_marks));
  IS_HELD("marks", riis_marks_get_list(shared_marks, RIIS_LIST_MARKED, &list, sizeof list));
  IS_HELD("mesh", riis_mesh_set_adjacency(of->mesh, NULL));
  CHECK_OK(riis_mesh_prepare(of->mesh, 1)); /* makes the same parts as a marking */
  IS_HELD("surface", riis_surface_update(of->surface, of->valve, NULL));
  CHECK_OK(riis_closest_point(of->surface, origin, &closest, sizeof closest));
  CHECK_OK(riis_marks_create(&other));
  CHECK_OK(riis_mark_nodes(of->surface, of->mesh, NULL, other)); /* several marks of one surface and mesh */
  riis_marks_destroy(&other);
  /* In a forked child, the call of the parent's other thread never ends, and must not keep the objects locked. */
  const pid_t child = fork();
  if (child == 0)
    _exit(riis_mesh_set_adjacency(of->mesh, NULL) == RIIS_OK &&
                  riis_marks_get_list(shared_marks, RIIS_LIST_MARKED, &list, sizeof list) == RIIS_OK
              ? 0
              : 1);
  int how = 0;
  assert_int_equal(waitpid(child, &how, 0), child);
  assert_int_equal(how, 0);
}

TEST(a_call_is_refused_while_another_thread_changes_its_objects) {
  /* The mesh is a thousand times as large as the valve, so its first marking sends a warning. */
  const int n_side = 11;
  static double far[3 * 11 * 11 * 11];
  shared_objects of = {new_valve("coapting"), NULL, NULL};
  for (int i = 0; i < n_side * n_side * n_side; ++i)
    for (int c = 0, rest = i; c < 3; ++c, rest /= n_side) far[3 * i + c] = 500.0 * (rest % n_side);
  CHECK_OK(riis_mesh_create(n_side * n_side * n_side, far, far + 1, far + 2, 3, &of.mesh));
  own(of.mesh);
  of.surface = new_surface(of.valve, NULL);
  CHECK_OK(riis_marks_create(&shared_marks));
  own(shared_marks);
  while_held(update_surface, use_what_is_updated, &of);
  assert_int_equal(status_of_call, RIIS_OK);
  while_held(mark, use_what_is_marked, &of);
  assert_int_equal(status_of_call, RIIS_OK);
  /* After the calls, no object is locked. */
  riis_mark_list list;
  CHECK_OK(riis_surface_update(of.surface, of.valve, NULL));
  CHECK_OK(riis_mark_nodes(of.surface, of.mesh, NULL, shared_marks));
  CHECK_OK(riis_marks_get_list(shared_marks, RIIS_LIST_MARKED, &list, sizeof list));
  CHECK_OK(riis_mesh_set_adjacency(of.mesh, NULL));
  CHECK_OK(riis_valve_set_open_state(of.valve, of.valve)); /* a call may name an object twice */
}

TEST(threads_that_change_the_same_objects_fail_or_give_right_marks) {
  nodes = lattice_around(aortic_surface(NULL), 0.2, 0.2);
  const shared_objects of = new_objects();
  riis_mark_stats first;
  int n_wrong = 0, n_made = 0;
  CHECK_OK(riis_marks_create(&shared_marks));
  own(shared_marks);
  CHECK_OK(riis_valve_set_scalar(of.valve, "opening", 0));
  CHECK_OK(riis_surface_update(of.surface, of.valve, NULL));
  CHECK_OK(riis_mark_nodes(of.surface, of.mesh, NULL, shared_marks));
  CHECK_OK(riis_marks_get_stats(shared_marks, &first, sizeof first));
  assert_true(first.n_marked > 0);
#pragma omp parallel num_threads(4) reduction(+ : n_wrong, n_made)
  for (int i = 0; i < trials(100, 1000); ++i) {
    riis_mark_stats stats = {.n_marked = -1};
    const riis_status statuses[] = {riis_valve_set_scalar(of.valve, "opening", 0),
                                    riis_surface_update(of.surface, of.valve, NULL),
                                    riis_mark_nodes(of.surface, of.mesh, NULL, shared_marks),
                                    riis_marks_get_stats(shared_marks, &stats, sizeof stats)};
    for (int c = 0; c < 4; ++c) n_wrong += statuses[c] != RIIS_OK && statuses[c] != RIIS_UNAVAILABLE;
    n_made += statuses[2] == RIIS_OK;
    n_wrong += stats.n_marked >= 0 && stats.n_marked != first.n_marked;
  }
  assert_int_equal(n_wrong, 0);
  assert_true(n_made > 0);
}

int main(void) { return run_cases(NULL, NULL); }
