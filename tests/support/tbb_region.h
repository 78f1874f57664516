/* SPDX-License-Identifier: Apache-2.0
 * Lets C tests run code that uses TBB as a caller of the library would. The assertions stay in C: a failed assertion leaves by
 * longjmp, which must not cross TBB's stack frames. */
#ifndef RIIS_TEST_TBB_REGION_H
#define RIIS_TEST_TBB_REGION_H

#ifdef __cplusplus
extern "C" {
#endif

/* The caller's parallel_for runs in its thread's default arena, in a task_arena(4), in a task_arena(1), or under a limit of 1
 * thread. The region of the task_arena(4) raises the limit to 4 threads, so tasks run at the same time on any machine. */
enum tbb_region { TBB_OWN_ARENA, TBB_ARENA_OF_FOUR, TBB_ARENA_OF_ONE, TBB_LIMIT_OF_ONE };

typedef struct tbb_seen {
  int n_changed;    /* the number of changed settings: the limit on threads, compared around the whole call and in the
                    region; and the arena, compared around the whole call, in the region and around each task */
  int most_at_once; /* the largest number of tasks that ran at the same time */
} tbb_seen;

/* Runs body(data, task) for 0 <= task < n_tasks as tasks of a tbb::parallel_for. In the arena of four, the first task waits
 * at most 10 seconds until a second task begins. The body must return. */
tbb_seen tbb_run(int region, int n_tasks, void (*body)(void *data, int task), void *data);

#ifdef __cplusplus
}
#endif

#endif
