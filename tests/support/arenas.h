/* SPDX-License-Identifier: Apache-2.0
 * Lets C tests start the parallel walks of src/riis/parallel from several callers at the same time. The assertions stay in C: a
 * failed assertion leaves by longjmp, which must not cross TBB's stack frames. A walk of these tests visits 32 numbers and adds
 * 32 more. The walk is correct if it visits each number once. */
#ifndef RIIS_TEST_ARENAS_H
#define RIIS_TEST_ARENAS_H

#ifdef __cplusplus
extern "C" {
#endif

/* A keeper of arenas, which each handle of the library has. TBB's arenas exist until the last keeper is gone. */
typedef struct arenas_keeper arenas_keeper;
arenas_keeper *arenas_keep(void);
void arenas_let_go(arenas_keeper **keeper);

/* Returns the number of arenas. */
int arenas_made(void);

typedef struct walk_seen {
  int is_right;
  int arena; /* the largest number of threads of the arena in which the bodies ran; -1 if two bodies saw different numbers */
} walk_seen;

walk_seen walk_once(int n_threads);
/* Makes a walk while the caller limits the process to `limit` threads. */
walk_seen walk_under_limit(int limit, int n_threads);
/* Makes a walk in which every body throws. Returns 1 if the caller gets the exception. */
int walk_that_throws(int n_threads);
/* Starts n_callers threads. Each thread makes n_walks walks, with 2 and 3 threads in turn. The first walks of all threads have 2
 * threads and run at the same time. Returns 1 if all walks are correct. */
int walk_at_once(int n_callers, int n_walks);
/* Runs n_tasks tasks of the caller's own TBB in an arena of four threads. Each task makes a walk. Returns 1 if all walks are
 * correct and the tasks stay in their arena. */
int walk_in_tasks(int n_tasks);
/* Returns 1 if TBB can be shut down. TBB refuses to shut down while an arena exists. */
int end_tbb(void);

#ifdef __cplusplus
}
#endif

#endif
