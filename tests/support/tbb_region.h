/* SPDX-License-Identifier: Apache-2.0
 * TBB as a caller of the library would use it, with a C interface: a failed assertion leaves by longjmp, which must not
 * cross TBB's frames. */
#ifndef RIIS_TEST_TBB_REGION_H
#define RIIS_TEST_TBB_REGION_H

#ifdef __cplusplus
extern "C" {
#endif

/* Where the caller's parallel_for runs: in its thread's own arena; in a task_arena(4) with a limit of 4 threads, so that
 * tasks run at once on any machine; in a task_arena(1); under a limit of 1 thread. */
enum tbb_region { TBB_OWN_ARENA, TBB_ARENA_OF_FOUR, TBB_ARENA_OF_ONE, TBB_LIMIT_OF_ONE };

typedef struct tbb_seen {
  int n_changed; /* settings that were not as before: of the threads allowed, around the whole and in the region; of the arena,
                    around the whole, in the region and around each task */
  int most_at_once; /* tasks under way at the same time */
} tbb_seen;

/* Runs body(data, task) for 0 <= task < n_tasks as tasks of a tbb::parallel_for. In the arena of four the first task waits for
 * a second one to begin, 10 seconds at most. The body must return. */
tbb_seen tbb_run(int region, int n_tasks, void (*body)(void *data, int task), void *data);

#ifdef __cplusplus
}
#endif

#endif
