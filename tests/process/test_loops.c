/* SPDX-License-Identifier: Apache-2.0
 * The loops of a time step run on OpenMP's threads until a loop has waited for one of these threads. Then the loops run for a
 * while on a team, which does not wait for a late thread. If earlier teams have lost time, the calling thread works alone at
 * first, and calls a team later. OpenMP's threads always run the loops in two cases: if the user binds them to places
 * (OMP_PROC_BIND), and inside a caller's parallel region. */
#include "loops.h"
#include "sanitized.h"
#include "test_support.h"

#include <omp.h>

static int is_bound(void) { return omp_get_proc_bind() != omp_proc_bind_false; }

/* This case is the first of the tests, because the team then has only one worker. */
TEST(loops_end_while_a_thread_is_held) {
  assert_true(loops_while_a_thread_is_held(200));
  for (int i = 0; i < 2000 && !is_short_test(); ++i) assert_true(loops_while_a_thread_is_held(10));
}

/* This case runs before all other loops of OpenMP. After a long wait in such a loop, all loops would run on teams for a while. */
TEST(more_threads_than_processors_are_a_team) { assert_int_equal(too_many_threads_are_a_team(), !is_bound()); }

TEST(each_block_runs_once) {
  const int n_threads[] = {2, 5, 3, 1, 4, 2};
  for (int repeat = 0; repeat < 50; ++repeat)
    for (int i = 0; i < 6; ++i)
      for (int64_t n_blocks = 0; n_blocks < 40; n_blocks += 13) {
        const int n_expected = n_blocks > 1 ? n_threads[i] : 1;
        assert_int_equal(team_loop_once(n_blocks, n_threads[i]), n_expected);
        /* In OpenMP, every thread waits for all others, which takes long on a busy machine. */
        if (repeat < 2) assert_int_equal(loop_once(n_blocks, n_threads[i]), n_expected);
      }
}

TEST(the_lowest_failing_block_is_reported) {
  random_source random = random_start("the_lowest_failing_block_is_reported");
  for (int repeat = 0; repeat < 300; ++repeat) {
    const int64_t n_blocks = 2 + (int64_t)(random_bits(&random) % 200);
    const int n_threads = 1 + (int)(random_bits(&random) % 20);
    int64_t failing[4], lowest = n_blocks;
    const int64_t n_failing = (int64_t)(random_bits(&random) % 5);
    for (int64_t i = 0; i < n_failing; ++i) {
      failing[i] = (int64_t)(random_bits(&random) % (uint64_t)n_blocks);
      if (failing[i] < lowest) lowest = failing[i];
    }
    assert_int_equal(block_whose_exception_comes(n_blocks, n_threads, n_failing, failing, 1), lowest);
    if (repeat < 20) assert_int_equal(block_whose_exception_comes(n_blocks, 2, n_failing, failing, 0), lowest);
  }
}

TEST(lower_blocks_run_after_a_failure) {
  int64_t n_higher = 0;
  assert_int_equal(block_that_fails_first(100, 30, &n_higher), 30);
  /* Rarely, the exception is stored only after the calling thread has gone on. */
  int n_with_none = 0;
  for (int repeat = 0; repeat < 20; ++repeat) {
    assert_int_equal(block_that_fails_first(100, -1, &n_higher), 50);
    n_with_none += n_higher == 0;
  }
  assert_true(n_with_none > 0);
}

TEST(callers_do_not_disturb_each_other) { assert_true(loops_at_once(5, is_bound() ? 5 : 100)); }

TEST(a_callers_region_may_nest) {
  assert_int_equal(loop_in_a_region(1), 1);
  assert_int_equal(loop_in_a_region(2), 2);
}

TEST(the_threads_leave_signals_to_the_caller) {
  const loop_threads seen = threads_of_a_loop();
  assert_false(seen.takes_signals);
  assert_true(seen.takes_error_signals);
}

/* This test would wait for ever if a loop waited for all of its threads, or for a lock that a delayed thread has. To test the
 * lock, the thread must be delayed at many points of its code. A delayed thread must not hold a sanitizer's lock. With a
 * sanitizer, the thread is therefore delayed only once, while it sleeps. This test is first, because the team then has only one
 * additional thread. */
TEST(a_long_wait_chooses_a_team) {
  if (is_bound())
    assert_false(wait_long_for_a_thread());
  else
    assert_true(wait_long_for_a_thread());
}

/* Times are in milliseconds here. */
static int takes_team_at(double now, int n_loops, const double *waited, const double *ended) {
  int64_t times[2][40] = {{0}};
  for (int i = 0; i < n_loops; ++i) {
    times[0][i] = (int64_t)(1e6 * waited[i]);
    times[1][i] = (int64_t)(1e6 * ended[i]);
  }
  return choice_after(n_loops, times[0], times[1], (int64_t)(1e6 * now));
}

TEST(the_choice_lasts_for_a_while) {
  const double brief[] = {1.9}, waits[8] = {10, 5, 5, 5, 5, 5, 5, 5};
  const double ended[] = {100, 400, 1000};
  assert_false(takes_team_at(1, 0, NULL, NULL));
  assert_false(takes_team_at(101, 1, brief, ended)); /* blocks of unequal length */
  assert_true(takes_team_at(101, 1, waits, ended));
  assert_true(takes_team_at(349, 1, waits, ended));
  assert_false(takes_team_at(351, 1, waits, ended));
  /* The first loop after the pause waits a second time, so the next pause is twice as long. */
  assert_true(takes_team_at(899, 2, waits, ended));
  assert_false(takes_team_at(901, 2, waits, ended));
  assert_true(takes_team_at(1999, 3, waits, ended));
  assert_false(takes_team_at(2001, 3, waits, ended));
  /* No pause is longer than 2 s. */
  const double ends[8] = {0, 300, 900, 2000, 4100, 6200, 8300, 10400};
  assert_true(takes_team_at(12399, 8, waits, ends));
  assert_false(takes_team_at(12401, 8, waits, ends));
}

/* Two waits double the pause to 500 ms. Then n_calm loops do not wait, and the last loop waits. The n_calm loops and the last
 * loop end at 1000 ms. */
static int takes_team_after_calm(double now, int n_calm) {
  double waits[40] = {10, 5}, ended[40] = {100, 400};
  for (int i = 0; i <= n_calm; ++i) ended[2 + i] = 1000;
  waits[2 + n_calm] = 5;
  return takes_team_at(now, 3 + n_calm, waits, ended);
}

/* Some loops wait long even on a quiet machine. */
TEST(rare_waits_do_not_prolong_the_choice) {
  assert_true(takes_team_after_calm(1999, 31));
  assert_false(takes_team_after_calm(2001, 31));
  assert_true(takes_team_after_calm(1249, 32));
  assert_false(takes_team_after_calm(1251, 32));
}

/* Times are in milliseconds here. */
static double alone_at(double now, int n_loops, const double *lost, const double *ended) {
  int64_t times[2][64] = {{0}};
  for (int i = 0; i < n_loops; ++i) {
    times[0][i] = (int64_t)(1e6 * lost[i]);
    times[1][i] = (int64_t)(1e6 * ended[i]);
  }
  return 1e-6 * (double)time_alone_after(n_loops, times[0], times[1], (int64_t)(1e6 * now));
}

TEST(a_loop_is_alone_for_the_mean_loss) {
  double lost[64] = {4}, ended[64] = {0};
  for (int i = 0; i < 64; ++i) ended[i] = 100;
  assert_true(alone_at(1, 0, NULL, NULL) == 0);
  /* A sixteenth of a loss counts, and the counted part halves in each second. */
  CHECK_NEAR(alone_at(100, 1, lost, ended), 4.0 / 16, 1e-5);
  CHECK_NEAR(alone_at(1100, 1, lost, ended), 4.0 / 32, 1e-5);
  CHECK_NEAR(alone_at(3100, 1, lost, ended), 4.0 / 128, 1e-5);
  assert_true(alone_at(7000, 1, lost, ended) == 0);
  /* A loop without a loss reduces the mean, and a gain counts as no loss. */
  lost[1] = -3;
  CHECK_NEAR(alone_at(100, 2, lost, ended), 4.0 / 16 * 15 / 16, 1e-5);
  assert_true(alone_at(100, 64, lost, ended) < 5e-3);
  for (int i = 0; i < 64; ++i) lost[i] = 4;
  CHECK_NEAR(alone_at(100, 64, lost, ended), 4 * (1 - pow(15.0 / 16, 64)), 1e-5);
}

TEST(the_caller_calls_a_team_late) {
  assert_true(caller_begins_alone());
  assert_true(caller_calls_a_team_later());
}

int main(void) { return run_cases(NULL, NULL); }
