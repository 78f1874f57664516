/* SPDX-License-Identifier: Apache-2.0
 * Walks along an adjacency run in TBB arenas. An arena is kept for later walks, and serves one walk at a time. */
#include <riis/riis.h>

#include "test_support.h"

#include <sys/wait.h>
#include <unistd.h>

#include "arenas.h"

static int keep(void **state) {
  *state = arenas_keep();
  return 0;
}

static int let_go(void **state) {
  arenas_let_go((arenas_keeper **)state);
  return 0;
}

static void expect_walk(walk_seen seen, int arena) {
  assert_true(seen.is_right);
  assert_int_equal(seen.arena, arena);
}

TEST_WITH(one_caller_has_one_arena, keep, let_go) {
  for (int i = 0; i < 200; ++i) {
    expect_walk(walk_once(2), 2);
  }
  assert_int_equal(arenas_made(), 1);
  assert_true(walk_once(1).is_right); /* a walk with one thread uses no TBB */
  assert_int_equal(arenas_made(), 1);
}

TEST_WITH(each_number_of_threads_has_one, keep, let_go) {
  for (int i = 0; i < 100; ++i)
    for (int n_threads = 2; n_threads <= 4; ++n_threads) expect_walk(walk_once(n_threads), n_threads);
  assert_int_equal(arenas_made(), 3);
}

TEST_WITH(callers_at_once_have_one_each, keep, let_go) {
  assert_true(walk_at_once(2, 1));
  assert_int_equal(arenas_made(), 2);
  /* Five callers at the same time need an arena of two threads each. At most five arenas of three threads exist. */
  assert_true(walk_at_once(5, 200));
  assert_in_range(arenas_made(), 6, 10);
}

TEST_WITH(the_callers_limit_is_kept, keep, let_go) {
  const int limits[] = {4, 1, 2, 1, 3, 4};
  for (int repeat = 0; repeat < 20; ++repeat)
    for (int i = 0; i < 6; ++i) {
      expect_walk(walk_under_limit(limits[i], 4), limits[i]);
      expect_walk(walk_once(4), 4); /* as many threads as requested, even with fewer processors */
    }
  assert_int_equal(arenas_made(), 4); /* with 1, 2, 3 and 4 threads */
}

TEST_WITH(an_arena_comes_back_when_a_body_throws, keep, let_go) {
  for (int i = 0; i < 100; ++i) {
    assert_true(walk_that_throws(3));
    expect_walk(walk_once(3), 3);
  }
  assert_int_equal(arenas_made(), 1);
}

TEST_WITH(the_callers_tasks_have_at_most_one_each, keep, let_go) {
  assert_true(walk_in_tasks(500));
  assert_in_range(arenas_made(), 1, 4);
}

TEST_WITH(arenas_go_with_the_last_who_keeps_them, keep, let_go) {
  arenas_keeper *second = arenas_keep();
  expect_walk(walk_once(2), 2);
  arenas_let_go((arenas_keeper **)fixture);
  assert_int_equal(arenas_made(), 1);
  expect_walk(walk_once(3), 3);
  arenas_let_go(&second);
  assert_int_equal(arenas_made(), 0);
  assert_true(end_tbb());
  *fixture = arenas_keep();
  expect_walk(walk_once(2), 2);
  assert_int_equal(arenas_made(), 1);
}

TEST_WITH(a_child_of_fork_walks_alone_and_ends, keep, let_go) {
  expect_walk(walk_once(2), 2);
  fflush(NULL);
  const pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    const int is_right = walk_once(1).is_right;
    arenas_let_go((arenas_keeper **)fixture);
    exit(is_right ? 0 : 1);
  }
  int status = -1;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFEXITED(status));
  assert_int_equal(WEXITSTATUS(status), 0);
  expect_walk(walk_once(2), 2);
  assert_int_equal(arenas_made(), 1);
}

/* The handler of the process's exit was registered first, so it runs last. The handler stands for the destructor of a caller's
 * static object, which may start a walk. */
static pid_t process;
static void walk_at_exit(void) {
  if (getpid() != process) return; /* a forked child also comes here */
  arenas_keeper *keeper = arenas_keep();
  const int is_right = walk_once(2).is_right;
  arenas_let_go(&keeper);
  if (!is_right) _exit(3);
}

int main(void) {
  process = getpid();
  if (atexit(walk_at_exit) != 0) return 2;
  return run_cases(NULL, NULL);
}
