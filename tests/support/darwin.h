/* SPDX-License-Identifier: Apache-2.0
 * Functions of Linux that the tests call and that macOS lacks. On macOS CMake includes this file in each C file of the tests. */
#ifndef RIIS_TEST_DARWIN_H
#define RIIS_TEST_DARWIN_H

#include <pthread.h>

/* A barrier: pthread_barrier_wait returns when n_threads threads have called it. */
typedef struct {
  pthread_mutex_t mutex;
  pthread_cond_t have_all_come;
  unsigned n_threads, n_waiting, n_rounds;
} pthread_barrier_t;

static inline int pthread_barrier_init(pthread_barrier_t *barrier, const void *attributes, unsigned n_threads) {
  (void)attributes;
  barrier->n_threads = n_threads, barrier->n_waiting = 0, barrier->n_rounds = 0;
  return pthread_mutex_init(&barrier->mutex, 0) != 0 || pthread_cond_init(&barrier->have_all_come, 0) != 0;
}
static inline int pthread_barrier_wait(pthread_barrier_t *barrier) {
  pthread_mutex_lock(&barrier->mutex);
  const unsigned round = barrier->n_rounds;
  if (++barrier->n_waiting == barrier->n_threads) {
    barrier->n_waiting = 0;
    ++barrier->n_rounds;
    pthread_cond_broadcast(&barrier->have_all_come);
  }
  while (round == barrier->n_rounds) pthread_cond_wait(&barrier->have_all_come, &barrier->mutex);
  pthread_mutex_unlock(&barrier->mutex);
  return 0;
}
static inline int pthread_barrier_destroy(pthread_barrier_t *barrier) {
  return pthread_cond_destroy(&barrier->have_all_come) != 0 || pthread_mutex_destroy(&barrier->mutex) != 0;
}

/* macOS lacks floating-point traps, so the test of traps is skipped. */
static inline int feenableexcept(int traps) { return (void)traps, -1; }
static inline int fedisableexcept(int traps) { return (void)traps, 0; }
static inline int fegetexcept(void) { return 0; }

#endif
