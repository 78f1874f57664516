/* SPDX-License-Identifier: Apache-2.0
 * Without semaphores a loop runs on the calling thread, as it does without memory for threads. The functions below replace those
 * of the C library, and fail as on Darwin. */
#include "loops.h"
#include "test_support.h"

#include <errno.h>
#include <semaphore.h>
#include <stdatomic.h>

static atomic_int n_refused, n_used;

int sem_init(sem_t *semaphore, int is_shared, unsigned value) {
  (void)semaphore, (void)is_shared, (void)value;
  atomic_fetch_add(&n_refused, 1);
  errno = ENOSYS;
  return -1;
}

static int use(void) {
  atomic_fetch_add(&n_used, 1);
  errno = EBADF;
  return -1;
}
int sem_wait(sem_t *semaphore) { return (void)semaphore, use(); }
int sem_post(sem_t *semaphore) { return (void)semaphore, use(); }

TEST(a_team_without_semaphores_is_the_calling_thread) {
  for (int n_threads = 1; n_threads < 6; ++n_threads)
    for (int64_t n_blocks = 0; n_blocks < 40; n_blocks += 13) assert_int_equal(team_loop_once(n_blocks, n_threads), 1);
  assert_true(loops_at_once(3, 100));
  assert_true(atomic_load(&n_refused) > 0);
  assert_int_equal(atomic_load(&n_used), 0);
}

TEST(an_exception_leaves_the_loop) {
  const int64_t failing[] = {30, 7};
  assert_int_equal(block_whose_exception_comes(40, 4, 2, failing, 1), 7);
}

int main(void) { return run_cases(NULL, NULL); }
