/* SPDX-License-Identifier: Apache-2.0
 * The loops of a time step run on the library's own threads, and do not wait for a thread that does not come. In a process whose
 * user binds OpenMP's threads to places (OMP_PROC_BIND), and inside a caller's parallel region, the threads are OpenMP's. */
#include "loops.h"
#include "test_support.h"

#include <omp.h>

static int is_bound(void) { return omp_get_proc_bind() != omp_proc_bind_false; }

static void each_block_runs_once(void **state) {
  (void)state;
  const int n_threads[] = {2, 5, 3, 1, 4, 2};
  const int n_repeats =
      is_bound() ? 2 : 50; /* OpenMP's threads wait for each other, which takes long on a busy machine */
  for (int repeat = 0; repeat < n_repeats; ++repeat)
    for (int i = 0; i < 6; ++i)
      for (int64_t n_blocks = 0; n_blocks < 40; n_blocks += 13)
        assert_int_equal(loop_once(n_blocks, n_threads[i]), n_blocks > 1 ? n_threads[i] : 1);
}

static void callers_do_not_disturb_each_other(void **state) {
  (void)state;
  assert_true(loops_at_once(5, is_bound() ? 5 : 300));
}

static void a_callers_region_may_nest(void **state) {
  (void)state;
  assert_int_equal(loop_in_a_region(1), 1);
  assert_int_equal(loop_in_a_region(2), 2);
}

static void the_threads_leave_signals_to_the_caller(void **state) {
  (void)state;
  const loop_threads seen = threads_of_a_loop();
  assert_int_equal(seen.are_openmps, is_bound());
  assert_int_equal(seen.takes_signals, is_bound());
  assert_true(seen.takes_error_signals);
}

/* This would wait for ever if a loop waited for all of its threads. */
static void loops_end_while_a_thread_is_held(void **state) {
  (void)state;
  if (!is_bound()) assert_true(loops_while_a_thread_is_held(200));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_block_runs_once),
      cmocka_unit_test(callers_do_not_disturb_each_other),
      cmocka_unit_test(a_callers_region_may_nest),
      cmocka_unit_test(the_threads_leave_signals_to_the_caller),
      cmocka_unit_test(loops_end_while_a_thread_is_held),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
