/* SPDX-License-Identifier: Apache-2.0
 * Marking inside tasks of the caller's TBB gives the same bits as marking outside. The caller's settings stay as they were. */
#include <riis/riis.h>

#include "test_support.h"

#include <unistd.h>

#include "handles.h"
#include "searches.h"
#include "tbb_region.h"

enum { n_tasks = 12 };
static const int32_t thread_counts[] = {1, 2, 4};

typedef struct work {
  const riis_surface *surface;
  const riis_mesh *mesh;
  const riis_marks *expected;
  int32_t n_threads; /* 0: the tasks use 1, 2 and 4 threads in turn */
  int is_wrong[n_tasks];
} work;

/* Marks twice into a separate result. This function asserts nothing, because it may run on any thread. */
static void mark(void *data, int task) {
  work *w = data;
  riis_mark_options options = {0};
  riis_marks *result = NULL;
  riis_mark_stats stats = {0};
  int wrong = riis_mark_options_init(&options, sizeof options) || riis_marks_create(&result);
  options.search = RIIS_SEARCH_NEIGHBOR;
  options.n_threads = w->n_threads ? w->n_threads : thread_counts[task % 3];
  for (int step = 0; step < 2; ++step)
    wrong = wrong || riis_mark_nodes(w->surface, w->mesh, &options, result) || !same_results(result, w->expected) ||
            riis_marks_get_stats(result, &stats, sizeof stats) || stats.search != RIIS_SEARCH_NEIGHBOR ||
            !stats.complete || stats.n_threads < 1 || stats.n_threads > options.n_threads;
  w->is_wrong[task] = wrong;
  riis_marks_destroy(&result);
}

static void expect_same_as_outside(int region) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, is_short_test() ? 0.13 : 0.09, 0.2);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_marks *expected = new_result();
  riis_mark_options options = mark_options();
  options.search = RIIS_SEARCH_NEIGHBOR;
  options.n_threads = 1;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, expected));
  CHECK_MET(marked_in(expected).n > 1000);
  int most_at_once = 0;
  for (int count = 0; count < 4; ++count)
    for (int repeat = 0; repeat < trials_of(9); ++repeat) {
      /* The mesh is new each time, so one of the tasks must prepare it. */
      free_one_owned(mesh);
      mesh = mesh_from(&nodes);
      work w = {.surface = surface, .mesh = mesh, .expected = expected};
      w.n_threads = count < 3 ? thread_counts[count] : 0;
      for (int task = 0; task < n_tasks; ++task) w.is_wrong[task] = 1; /* wrong until the task has run */
      const tbb_seen seen = tbb_run(region, n_tasks, mark, &w);
      for (int task = 0; task < n_tasks; ++task)
        if (w.is_wrong[task]) fail_msg("task %d, n_threads %d: wrong", task, (int)w.n_threads);
      assert_int_equal(seen.n_changed, 0);
      if (seen.most_at_once > most_at_once) most_at_once = seen.most_at_once;
    }
  printf("at most %d tasks at once\n", most_at_once);
  if (region == TBB_ARENA_OF_FOUR) assert_true(most_at_once >= 2);
  if (region == TBB_ARENA_OF_ONE || region == TBB_LIMIT_OF_ONE) assert_int_equal(most_at_once, 1);
}

TEST(in_the_callers_loop) { expect_same_as_outside(TBB_OWN_ARENA); }

TEST(in_the_callers_arena_of_four) { expect_same_as_outside(TBB_ARENA_OF_FOUR); }

TEST(in_the_callers_arena_of_one) { expect_same_as_outside(TBB_ARENA_OF_ONE); }

TEST(under_the_callers_limit_of_one) { expect_same_as_outside(TBB_LIMIT_OF_ONE); }

int main(void) {
  /* Nothing may be printed. TBB reports on stderr if a caller requests more threads than it can give. */
  FILE *captured = tmpfile();
  const int terminal = dup(STDERR_FILENO);
  if (!captured || terminal < 0 || dup2(fileno(captured), STDERR_FILENO) < 0) return 1;
  int n_failed = run_cases(NULL, NULL); /* cmocka also writes to stderr */
  char line[256];
  dup2(terminal, STDERR_FILENO);
  for (rewind(captured); fgets(line, sizeof line, captured);) {
    fputs(line, stderr);
    if (n_failed == 0 && strstr(line, "TBB")) n_failed = 1;
  }
  fclose(captured);
  return n_failed;
}
