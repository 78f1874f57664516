/* SPDX-License-Identifier: Apache-2.0
 * A process may be forked while another thread is inside the library: the child finds the library's pools unlocked. It makes no
 * surface, because TBB would wait there for threads that the child lacks. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* fork */
#endif
#include <pthread.h>
#include <riis/riis.h>
#include <stdatomic.h>
#include <sys/wait.h>
#include <unistd.h>

#include "test_support.h"

#include "handles.h"
#include "sanitized.h"

enum { n_forks = 1000, child_passed = 17, seconds_for_a_child = 20 };

static atomic_int is_over;

/* Moves the valve and updates the surface on one thread. */
static riis_status step(riis_surface *surface, riis_valve *valve, double opening) {
  riis_surface_options options;
  riis_status status = riis_surface_options_init(&options, sizeof options);
  options.n_threads = 1;
  if (!status) status = riis_valve_set_scalar(valve, "opening", opening);
  return status ? status : riis_surface_update(surface, valve, &options);
}

/* Takes and gives back the library's memory until the test is over. Returns the first error. */
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

/* Makes and drops valves, whose values are in the pools. */
static riis_status copy_often(const riis_valve *valve) {
  riis_status status = RIIS_OK;
  for (int i = 0; i < 20 && !status; ++i) {
    riis_valve *copy = NULL;
    status = riis_valve_copy(valve, &copy);
    riis_valve_destroy(&copy);
  }
  return status;
}

/* Returns whether a forked process copies valves and ends by itself. A locked pool would stop it until its alarm. */
static int child_copies_valves(const riis_valve *valve) {
  int outcome = 0;
  const pid_t child = fork();
  if (child == 0) {
    alarm(seconds_for_a_child);
    _exit(copy_often(valve) ? 1 : child_passed);
  }
  return child > 0 && waitpid(child, &outcome, 0) == child && WIFEXITED(outcome) &&
         WEXITSTATUS(outcome) == child_passed;
}

/* The thread is at a pool's lock for a part of its time, so that a few of the forks meet a locked one. */
static void forked_processes_copy_valves(void **state) {
  (void)state;
  pthread_t thread;
  riis_status status_of_thread = RIIS_OK;
  int n_passed = 0;
  riis_valve *valve = new_valve("mitral");
  atomic_store(&is_over, 0);
  assert_int_equal(pthread_create(&thread, NULL, go_on_stepping, &status_of_thread), 0);
  for (int i = 0; i < fewer_if_sanitized(n_forks); ++i) n_passed += child_copies_valves(valve);
  atomic_store(&is_over, 1);
  assert_int_equal(pthread_join(thread, NULL), 0);
  CHECK_OK(status_of_thread);
  assert_int_equal(n_passed, fewer_if_sanitized(n_forks));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test_teardown(forked_processes_copy_valves, free_owned)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
