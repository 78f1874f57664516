/* SPDX-License-Identifier: Apache-2.0
 * Tests the neighbour search on several threads, which the library or the caller starts. */
#include <omp.h>
#include <pthread.h>
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "neighbor_checks.h"

/* --- Threads --------------------------------------------------------------------------------------------------------- */

TEST(any_number_of_threads_gives_the_same_bits) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, is_short_test() ? 0.07 : 0.05, 0.3);
  riis_mesh *mesh = mesh_from(&nodes);
  CHECK_MET(nodes.n > 50000);
  static const int32_t searches[2] = {RIIS_SEARCH_NEIGHBOR, RIIS_SEARCH_PAPER};
  for (int k = 0; k < 2; ++k) {
    const int owned_before = n_owned();
    riis_marks *one = marked_by(surface, mesh, searches[k], 1, NULL);
    assert_int_equal(stats_of(one).n_threads, 1);
    CHECK_MET(stats_of(one).n_marked > 5000);
    int32_t most[5] = {0};
    for (int repeat = 0; repeat < trials_of(9); ++repeat)
      for (int threads = 1; threads <= 4; ++threads) {
        const int n_outside = n_owned();
        riis_marks *many = marked_by(surface, mesh, searches[k], threads, NULL);
        const riis_mark_stats stats = stats_of(many);
        assert_true(same_results(one, many));
        assert_int_equal(stats.n_queries, stats_of(one).n_queries);
        assert_int_equal(stats.n_unreached, stats_of(one).n_unreached);
        assert_true(stats.n_threads >= 1 && stats.n_threads <= threads);
        if (stats.n_threads > most[threads]) most[threads] = stats.n_threads;
        free_owned_after(n_outside);
      }
    /* Several threads must really have run. The paper's search is a single walk. A second thread joins the walk only if the
     * system schedules the thread in time. */
    for (int repeat = 0; repeat < 500 && most[2] < 2; ++repeat) {
      const int n_outside = n_owned();
      riis_marks *two = marked_by(surface, mesh, searches[k], 2, NULL);
      most[2] = stats_of(two).n_threads;
      assert_true(same_results(one, two));
      free_owned_after(n_outside);
    }
    assert_int_equal(most[2], 2);
    free_owned_after(owned_before);
  }
  /* The first search of a mesh also makes the mesh's balls of nodes, with any number of threads. */
  riis_marks *one = marked_by(surface, mesh, RIIS_SEARCH_NEIGHBOR, 1, NULL);
  for (int threads = 1; threads <= 4; ++threads) {
    const int owned_before = n_owned();
    riis_mesh *fresh = mesh_from(&nodes);
    riis_marks *many = marked_by(surface, fresh, RIIS_SEARCH_NEIGHBOR, threads, NULL);
    assert_true(same_results(one, many));
    assert_int_equal(stats_of(many).n_queries, stats_of(one).n_queries);
    free_owned_after(owned_before);
  }
}

/* Returns 1 if one of several markings differs from the expected one. Each marking has its own result. */
static int marks_wrong(const riis_surface *surface, const riis_mesh *mesh, const riis_marks *expected, int n_threads) {
  riis_mark_options options = {0};
  riis_marks *result = NULL;
  int wrong = riis_mark_options_init(&options, sizeof options) || riis_marks_create(&result);
  options.search = RIIS_SEARCH_NEIGHBOR;
  options.n_threads = n_threads;
  for (int step = 0; step < 3; ++step)
    wrong = wrong || riis_mark_nodes(surface, mesh, &options, result) || !same_results(result, expected);
  riis_marks_destroy(&result);
  return wrong;
}

typedef struct caller {
  const riis_surface *surface;
  const riis_mesh *mesh;
  const riis_marks *expected;
  pthread_barrier_t *barrier;
  int n_threads, is_wrong;
} caller;

static void *mark_with_own_result(void *of) {
  caller *c = of;
  pthread_barrier_wait(c->barrier);
  c->is_wrong = marks_wrong(c->surface, c->mesh, c->expected, c->n_threads);
  return NULL;
}

/* The numbers of threads that a search of a mesh reports: by default, and if two threads are requested. Both searches find the
 * same nodes. */
typedef struct reported_threads {
  int32_t by_default, if_two;
} reported_threads;

static reported_threads threads_of(const riis_surface *surface, const test_mesh *nodes, int32_t search) {
  riis_mesh *mesh = mesh_from(nodes);
  riis_marks *found = marked_by(surface, mesh, search, 0, NULL);
  riis_marks *by_two = marked_by(surface, mesh, search, 2, NULL);
  const reported_threads reported = {stats_of(found).n_threads, stats_of(by_two).n_threads};
  assert_true(same_results(found, by_two));
  return reported;
}

TEST(the_default_has_the_threads_that_the_work_feeds) {
  const int32_t more = omp_get_num_procs() > 1 ? 2 : 1;
  riis_surface_options tiny = surface_options();
  tiny.scale = 0.05;
  riis_surface *surface = aortic_surface(NULL), *dot = aortic_surface(&tiny);
  const test_mesh few = lattice_around(surface, 0.12, 0.3), many = lattice_around(surface, 0.04, 0.3);
  assert_true(few.n > 8000 && few.n < 16384 && many.n > 250000);
  static const int32_t searches[3] = {RIIS_SEARCH_EXHAUSTIVE, RIIS_SEARCH_NEIGHBOR, RIIS_SEARCH_CLUSTERS};
  for (int k = is_short_test() ? 2 : 0; k < 3; ++k) {
    const int32_t search = searches[k];
    const reported_threads of_few = threads_of(surface, &few, search), of_many = threads_of(surface, &many, search),
                           of_dot = threads_of(dot, &many, search);
    assert_int_equal(of_few.by_default, 1);
    assert_int_equal(of_few.if_two, 2);
    assert_in_range(of_many.by_default, more, omp_get_num_procs());
    assert_int_equal(of_many.if_two, 2);
    /* The exhaustive search queries all nodes. The other searches query only the few nodes near the surface, so they use fewer
     * threads. */
    assert_in_range(of_dot.by_default, search == RIIS_SEARCH_EXHAUSTIVE ? more : 1,
                    search == RIIS_SEARCH_EXHAUSTIVE ? omp_get_num_procs() : 1);
  }
}

/* All threads use one surface and one mesh for the first time. The first caller makes the mesh's balls of nodes. */
TEST(several_caller_threads_at_once) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.1, 0.2);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_marks *expected = marked_by(surface, mesh, RIIS_SEARCH_EXHAUSTIVE, 1, NULL);
  free_one_owned(mesh);
  for (int n_callers = 2; n_callers <= 4; n_callers += 2)
    for (int n_threads = 1; n_threads <= 3; ++n_threads)
      for (int repeat = 0; repeat < trials(3, 3); ++repeat) {
        const int owned_before = n_owned();
        pthread_barrier_t barrier;
        pthread_t threads[4];
        caller callers[4];
        mesh = mesh_from(&nodes);
        assert_int_equal(pthread_barrier_init(&barrier, NULL, (unsigned)n_callers), 0);
        for (int i = 0; i < n_callers; ++i) {
          callers[i] = (caller){surface, mesh, expected, &barrier, n_threads, 0};
          assert_int_equal(pthread_create(&threads[i], NULL, mark_with_own_result, &callers[i]), 0);
        }
        for (int i = 0; i < n_callers; ++i) assert_int_equal(pthread_join(threads[i], NULL), 0);
        for (int i = 0; i < n_callers; ++i) assert_int_equal(callers[i].is_wrong, 0);
        pthread_barrier_destroy(&barrier);
        free_owned_after(owned_before);
      }
}

TEST(inside_the_callers_openmp) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.1, 0.2);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_marks *expected = marked_by(surface, mesh, RIIS_SEARCH_EXHAUSTIVE, 1, NULL);
  for (int n_threads = 0; n_threads <= 3; ++n_threads)
    for (int nested = 1; nested <= 2; ++nested) { /* tests nested regions too */
      if ((2 * n_threads + nested - 1) % trial_step()) continue;
      const int levels = omp_get_max_active_levels();
      int n_wrong = 0;
      omp_set_max_active_levels(nested);
      /* The mesh is new each time, so no search has prepared it. */
      free_one_owned(mesh);
      mesh = mesh_from(&nodes);
#pragma omp parallel num_threads(3) reduction(+ : n_wrong)
      n_wrong += marks_wrong(surface, mesh, expected, n_threads);
      assert_int_equal(n_wrong, 0);
      free_one_owned(mesh);
      mesh = mesh_from(&nodes);
#pragma omp parallel num_threads(3) shared(n_wrong)
#pragma omp single
      n_wrong += marks_wrong(surface, mesh, expected, n_threads);
      assert_int_equal(n_wrong, 0);
      free_one_owned(mesh);
      mesh = mesh_from(&nodes);
#pragma omp parallel num_threads(3) shared(n_wrong)
#pragma omp single
      for (int task = 0; task < 8; ++task) {
#pragma omp task shared(n_wrong)
        {
          const int wrong = marks_wrong(surface, mesh, expected, n_threads);
#pragma omp atomic
          n_wrong += wrong;
        }
      }
      assert_int_equal(n_wrong, 0);
      omp_set_max_active_levels(levels);
    }
}

TEST(the_callers_openmp_settings_stay) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.1, 0.2);
  const int threads = omp_get_max_threads(), dynamic = omp_get_dynamic(), levels = omp_get_max_active_levels();
  omp_set_num_threads(3);
  omp_set_dynamic(1);
  omp_set_max_active_levels(2);
  omp_set_schedule(omp_sched_guided, 7);
  for (int n_threads = 0; n_threads <= 4; ++n_threads) {
    const int owned_before = n_owned();
    riis_mesh *mesh = mesh_from(&nodes);
    riis_mark_options options = mark_options();
    options.n_threads = n_threads;
    check_same_as_exhaustive(surface, mesh, options, NULL);
    omp_sched_t kind;
    int chunk;
    omp_get_schedule(&kind, &chunk);
    assert_int_equal(omp_get_max_threads(), 3);
    assert_int_equal(omp_get_dynamic(), 1);
    assert_int_equal(omp_get_max_active_levels(), 2);
    assert_int_equal(kind, omp_sched_guided);
    assert_int_equal(chunk, 7);
    free_owned_after(owned_before);
  }
  omp_set_num_threads(threads);
  omp_set_dynamic(dynamic);
  omp_set_max_active_levels(levels);
}

int main(void) { return run_cases(NULL, NULL); }
