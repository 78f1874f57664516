/* SPDX-License-Identifier: Apache-2.0
 * Lets C tests run the loops of src/riis/parallel. The assertions stay in C, because a failed assertion leaves by longjmp. A loop
 * is correct if it runs each block once and no two threads have the same number. Each thread must also run its blocks in this
 * order: from its own share to the last block, then from the first block. */
#ifndef RIIS_TEST_LOOPS_H
#define RIIS_TEST_LOOPS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Runs a loop. Returns how many threads the loop had, or -1 if the loop was not correct. */
int loop_once(int64_t n_blocks, int n_threads);
/* Does what loop_once does, but on a team. */
int team_loop_once(int64_t n_blocks, int n_threads);
/* Runs a loop in which the failing blocks throw. Returns the block whose exception leaves the loop, or n_blocks if none does.
 * Returns -1 if a lower block did not run, or if a block ran twice. */
int64_t block_whose_exception_comes(int64_t n_blocks, int n_threads, int64_t n_failing, const int64_t *failing,
                                    int on_a_team);
/* Runs a loop on a team of two threads. The second thread's first block fails while the calling thread is in block 0. Later the
 * block `also_failing` fails, if it is not -1. Returns the block whose exception leaves the loop. *n_higher becomes the number of
 * blocks above this block that ran. Returns -1 if a lower block did not run, or if the second thread began outside its own
 * share. */
int64_t block_that_fails_first(int64_t n_blocks, int64_t also_failing, int64_t *n_higher);
/* Records how long loops of OpenMP waited and when they ended, in nanoseconds. Returns whether a loop that begins at `now` runs
   on a team. */
int choice_after(int n_loops, const int64_t *waited, const int64_t *ended, int64_t now);
/* Records the time that teams have lost, in nanoseconds. Returns how long the calling thread of the next loop runs alone. */
int64_t time_alone_after(int n_loops, const int64_t *lost, const int64_t *ended, int64_t now);
/* Returns whether the calling thread of a team runs all blocks of a short loop, which takes less time than the recorded
 * losses. */
int caller_begins_alone(void);
/* Returns whether a second thread joins a longer loop after the calling thread has run some blocks alone. */
int caller_calls_a_team_later(void);
/* Runs a loop and returns whether it ran on a team. */
int next_loop_is_on_a_team(void);
/* Returns whether a loop runs on a team if it has more threads than the machine has processors. */
int too_many_threads_are_a_team(void);
/* Runs a loop of OpenMP in which the calling thread waits 100 ms for the other thread. Returns whether the next loop runs on a
 * team. */
int wait_long_for_a_thread(void);
/* Starts n_callers threads. Each caller runs n_loops loops with 1 to 4 threads. Three out of four loops run on teams. Returns 1
 * if all loops are correct. */
int loops_at_once(int n_callers, int n_loops);
/* Runs a loop on two threads inside a parallel region of the caller. The caller may nest n_levels regions. Returns how many
 * threads each loop had, or -1. */
int loop_in_a_region(int n_levels);

typedef struct loop_threads {
  int takes_signals;       /* the second thread does not block SIGALRM */
  int takes_error_signals; /* the second thread does not block SIGSEGV */
} loop_threads;
/* Returns which signals the second thread of a team accepts. */
loop_threads threads_of_a_loop(void);

/* Runs n_loops loops on two threads, while the handler of a signal delays the second thread. The loops must end during this
 * delay. No earlier loop may have used more than two threads. Returns 1 if all loops are correct, if the calling thread ran all
 * blocks, and if the second thread later takes part again. */
int loops_while_a_thread_is_held(int n_loops);

#ifdef __cplusplus
}
#endif

#endif
