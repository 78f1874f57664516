/* SPDX-License-Identifier: Apache-2.0
 * A process may be forked while another thread is inside the library. In the child, the memory pools and locks are free. The
 * child here makes no surface, because TBB would wait for threads that the child lacks. If the parent used several threads, the
 * library runs on one thread in the child. The default is then one thread, and a request for more threads is refused. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* for fork */
#endif
#include <pthread.h>
#include <riis/riis.h>
#include <stdatomic.h>
#include <sys/wait.h>
#include <unistd.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "sanitized.h"

enum { n_forks = 1000, child_passed = 17, seconds_for_a_child = 120 };

static atomic_int is_over;

/* Moves the valve and updates the surface on one thread. */
static riis_status step(riis_surface *surface, riis_valve *valve, double opening) {
  riis_surface_options options;
  riis_status status = riis_surface_options_init(&options, sizeof options);
  options.n_threads = 1;
  if (!status) status = riis_valve_set_scalar(valve, "opening", opening);
  return status ? status : riis_surface_update(surface, valve, &options);
}

/* Allocates and frees the library's memory until the test is over. Returns the first error. */
static void *go_on_stepping(void *status_of_thread) {
  riis_status *status = status_of_thread;
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  *status = riis_valve_create("mitral", &valve);
  if (!*status) *status = riis_surface_create(valve, NULL, &surface);
  for (int i = 0; !*status && !atomic_load(&is_over); ++i) *status = step(surface, valve, 0.01 * (i % 100));
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return NULL;
}

/* Calls of riis_marks_create use TBB's arenas, and riis_set_log sets the log. Each call takes a lock for a moment. */
static riis_status take_locks(void) {
  riis_marks *marks = NULL;
  const riis_status status = riis_marks_create(&marks);
  riis_marks_destroy(&marks);
  riis_set_log(NULL, NULL);
  return status;
}

static void *go_on_locking(void *status_of_thread) {
  riis_status *status = status_of_thread;
  while (!*status && !atomic_load(&is_over)) *status = take_locks();
  return NULL;
}

/* Copies and destroys valves, whose values lie in the library's memory pools. */
static riis_status copy_often(const riis_valve *valve) {
  riis_status status = RIIS_OK;
  for (int i = 0; i < 20 && !status; ++i) {
    riis_valve *copy = NULL;
    status = riis_valve_copy(valve, &copy);
    riis_valve_destroy(&copy);
  }
  return status;
}

/* Returns whether a forked process can copy valves, take the locks and end. If a lock stayed locked, an alarm would end the
 * process. */
static int child_goes_on(const riis_valve *valve) {
  int outcome = 0;
  const pid_t child = fork();
  if (child == 0) {
    alarm(seconds_for_a_child);
    _exit(copy_often(valve) || take_locks() ? 1 : child_passed);
  }
  return child > 0 && waitpid(child, &outcome, 0) == child && WIFEXITED(outcome) &&
         WEXITSTATUS(outcome) == child_passed;
}

/* A second thread holds a lock part of the time, so some forks happen while a lock is held. The address sanitizer of gcc 12 does
 * not unlock its allocator in a child. The child may then wait for ever, so the tests of forks are omitted with the address
 * sanitizer of gcc. */
static void children_go_on_beside(void *(*other)(void *)) {
  if (is_sanitized()) skip();
  pthread_t thread;
  riis_status status_of_thread = RIIS_OK;
  int n_passed = 0;
  riis_valve *valve = new_valve("mitral");
  atomic_store(&is_over, 0);
  assert_int_equal(pthread_create(&thread, NULL, other, &status_of_thread), 0);
  for (int i = 0; i < n_forks && n_passed == i; ++i) n_passed += child_goes_on(valve);
  atomic_store(&is_over, 1);
  assert_int_equal(pthread_join(thread, NULL), 0);
  CHECK_OK(status_of_thread);
  assert_int_equal(n_passed, n_forks);
}

/* The objects that the parent made before the fork. */
typedef struct scene {
  riis_valve *valve;
  riis_surface *surface;
  test_mesh nodes;
  riis_mesh *mesh;
  riis_marks *result; /* marked by one thread, or by several */
  double *k;
} scene;

static scene scene_by(int32_t n_threads) {
  scene s = {.valve = new_valve("mitral"), .result = new_result()};
  riis_surface_options options = surface_options();
  options.n_threads = n_threads;
  s.surface = new_surface(s.valve, &options);
  s.nodes = lattice_around(s.surface, is_short_test() ? 0.13 : 0.08, 0.3);
  CHECK_MET(s.nodes.n > 50000);
  s.mesh = mesh_from(&s.nodes);
  s.k = own(calloc((size_t)s.nodes.n, sizeof *s.k));
  return s;
}

static riis_status mark(const scene *s, int32_t search, int32_t n_threads, riis_marks *result) {
  riis_mark_options options;
  riis_status status = riis_mark_options_init(&options, sizeof options);
  options.search = search;
  options.n_threads = n_threads;
  return status ? status : riis_mark_nodes(s->surface, s->mesh, &options, result);
}

/* Makes each call with the given n_threads. Returns how many calls give the status, and counts the calls. */
static int with_status(const scene *s, int32_t n_threads, riis_status expected, const char *text, int *n_calls) {
  riis_mark_options options;
  riis_surface_options of_surface;
  riis_crossing_options of_crossings;
  riis_closest_options of_points;
  riis_closest_arrays found;
  riis_mesh_cells cells;
  riis_mesh_faces faces;
  riis_leak_list leaks;
  riis_passage passage;
  riis_crossing_list crossings;
  riis_marks *result = NULL;
  riis_adjacency *adjacency[3] = {NULL};
  static const int32_t ids[4] = {0, 1, 2, 3};
  const int64_t first = 0, last = s->nodes.n - 1;
  int64_t *label = malloc((size_t)s->nodes.n * sizeof *label);
  double *distance = malloc((size_t)s->nodes.n * sizeof *distance);
  riis_mark_options_init(&options, sizeof options);
  riis_surface_options_init(&of_surface, sizeof of_surface);
  riis_crossing_options_init(&of_crossings, sizeof of_crossings);
  riis_closest_options_init(&of_points, sizeof of_points);
  riis_closest_arrays_init(&found, sizeof found);
  riis_mesh_cells_init(&cells, sizeof cells);
  riis_mesh_faces_init(&faces, sizeof faces);
  riis_marks_create(&result);
  options.n_threads = of_surface.n_threads = of_crossings.n_threads = of_points.n_threads = n_threads;
  cells.n_threads = faces.n_threads = n_threads;
  cells.n_nodes = 4, cells.n_cells = 1, cells.node_ids = ids;
  faces.n_cells = 4, faces.n_faces = 2, faces.owner = ids, faces.neighbor = ids + 2;
  found.distance = distance;
  int n_as_expected = 0;
#define EXPECT(call) n_as_expected += (call) == expected && (!text || strstr(riis_last_error(), text)), ++*n_calls
  for (int32_t search = RIIS_SEARCH_AUTO; search <= RIIS_SEARCH_CLUSTERS; ++search)
    EXPECT(mark(s, search, n_threads, result));
  EXPECT(riis_mesh_prepare(s->mesh, n_threads));
  EXPECT(find_leaks_in(s->surface, s->mesh, s->result, &options, &leaks));
  EXPECT(riis_label_open_regions(s->mesh, s->result, &options, s->nodes.n, label, NULL));
  EXPECT(find_passage_between(s->surface, s->mesh, &options, 1, &first, 1, &last, &passage, sizeof passage));
  EXPECT(find_crossings_in(s->surface, &of_crossings, &crossings));
  EXPECT(closest_points_of(s->surface, s->nodes.n, s->nodes.xyz, s->nodes.xyz + 1, s->nodes.xyz + 2, 3, &of_points,
                           &found));
  EXPECT(riis_adjacency_create_from_cells(&cells, &adjacency[0]));
  EXPECT(riis_adjacency_create_from_faces(&faces, &adjacency[1]));
  EXPECT(riis_adjacency_create_from_grid(30, 40, 50, n_threads, &adjacency[2]));
  EXPECT(riis_surface_update(s->surface, s->valve, &of_surface));
#undef EXPECT
  for (int i = 0; i < 3; ++i) riis_adjacency_destroy(&adjacency[i]);
  riis_marks_destroy(&result);
  free(label);
  free(distance);
  return n_as_expected;
}

/* Copies the parent's marks to arrays, whether the marking used one thread or several. */
static riis_status use_result(const scene *s) {
  riis_resistance resistance;
  riis_status status = riis_resistance_init(&resistance, sizeof resistance);
  resistance.R = 1;
  if (!status) status = add_resistance_to(s->result, &resistance, s->nodes.n, s->k, NULL);
  return status ? status : dense_of(s->result, s->nodes.n, RIIS_FAR_DISTANCE, NULL, s->k, NULL, NULL);
}

/* A check that the child runs. Returns 0 if all is right. */
typedef int child_check(const scene *s);

static int run_child(child_check *check, const scene *s) {
  int outcome = -1;
  fflush(NULL);
  const pid_t child = fork();
  if (child == 0) {
    alarm(seconds_for_a_child);
    _exit(check(s) ? 1 : child_passed);
  }
  assert_true(child > 0);
  assert_int_equal(waitpid(child, &outcome, 0), child);
  return WIFEXITED(outcome) && WEXITSTATUS(outcome) == child_passed;
}

static int all_have(const scene *s, int32_t n_threads, riis_status expected, const char *text) {
  int n_calls = 0;
  const int n = with_status(s, n_threads, expected, text, &n_calls);
  return n_calls == 15 && n == n_calls;
}

static int marks_are_as_before(const scene *s, int32_t n_threads, int32_t *n_ran) {
  riis_marks *result = NULL;
  riis_mark_stats stats;
  const int is_right = !riis_marks_create(&result) && !mark(s, RIIS_SEARCH_CLUSTERS, n_threads, result) &&
                       same_results(s->result, result) && !riis_marks_get_stats(result, &stats, sizeof stats);
  if (is_right) *n_ran = stats.n_threads;
  riis_marks_destroy(&result);
  return is_right;
}

static int marks_in_a_grandchild(const scene *s) {
  int32_t n_ran = 0;
  return !marks_are_as_before(s, 0, &n_ran) || mark(s, RIIS_SEARCH_AUTO, 2, s->result) != RIIS_UNAVAILABLE;
}

static int has_one_thread(const scene *s) {
  int32_t n_ran = 0;
  if (use_result(s)) return 1;
  if (!marks_are_as_before(s, 1, &n_ran) || n_ran != 1) return 2;
  if (!marks_are_as_before(s, 0, &n_ran) || n_ran != 1) return 3;
  if (!all_have(s, 2, RIIS_UNAVAILABLE, "n_threads is 2; this process was forked")) return 4;
  if (!all_have(s, 1, RIIS_OK, NULL) || !all_have(s, 0, RIIS_OK, NULL)) return 5;
  if (mark(s, RIIS_SEARCH_AUTO, -1, s->result) != RIIS_INVALID_ARGUMENT) return 6;
  return run_child(marks_in_a_grandchild, s) ? 0 : 7;
}

static int has_threads(const scene *s) {
  int32_t n_ran = 0;
  if (!marks_are_as_before(s, 2, &n_ran) || n_ran != 2) return 1;
  return all_have(s, 2, RIIS_OK, NULL) ? 0 : 2;
}

/* The test of a parent with one thread runs first, because the process has not used threads yet. */
TEST(a_child_of_one_thread_has_threads) {
  const scene s = scene_by(1);
  CHECK_OK(mark(&s, RIIS_SEARCH_CLUSTERS, 1, s.result));
  assert_true(run_child(has_threads, &s));
}

TEST(a_child_of_several_threads_has_one) {
  const scene s = scene_by(2);
  for (int32_t search = RIIS_SEARCH_NEIGHBOR; search <= RIIS_SEARCH_CLUSTERS; ++search)
    CHECK_OK(mark(&s, search, 2, s.result));
  assert_true(run_child(has_one_thread, &s));
  int32_t n_ran = 0;
  assert_true(marks_are_as_before(&s, 2, &n_ran)); /* the parent keeps its threads */
  assert_int_equal(n_ran, 2);
}

TEST(memory_is_free_in_children) { children_go_on_beside(go_on_stepping); }

TEST(locks_are_free_in_children) { children_go_on_beside(go_on_locking); }

int main(void) { return run_cases(NULL, NULL); }
