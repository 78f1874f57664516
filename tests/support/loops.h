/* SPDX-License-Identifier: Apache-2.0
 * C wrappers of the loops of src/riis/parallel. The assertions stay in C, because a failed assertion leaves by longjmp. A loop is
 * correct if it runs each block once, and if no two threads have the same number. A thread's blocks must also ascend: from its
 * own share to the last block, and then from the first block. */
#ifndef RIIS_TEST_LOOPS_H
#define RIIS_TEST_LOOPS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns how many threads the loop had, or -1 if it was not correct. */
int loop_once(int64_t n_blocks, int n_threads);
/* Does the same on a team. */
int team_loop_once(int64_t n_blocks, int n_threads);
/* Runs a loop whose failing blocks throw. Returns the block whose exception leaves the loop, or n_blocks if no exception
 * does. Returns -1 if a lower block did not run or a block ran twice. */
int64_t block_whose_exception_comes(int64_t n_blocks, int n_threads, int64_t n_failing, const int64_t *failing,
                                    int on_a_team);
/* Runs a loop on a team of two threads. The second thread's first block fails while the calling thread is in block 0. Later
 * `also_failing` fails, unless it is -1. Returns the block whose exception leaves the loop. *n_higher becomes the number of
 * blocks above it that ran. Returns -1 if a lower block did not run, or if the second thread did not begin with its own share. */
int64_t block_that_fails_first(int64_t n_blocks, int64_t also_failing, int64_t *n_higher);
/* Records loops of OpenMP, times in nanoseconds, and returns whether a loop that begins now takes a team. */
int choice_after(int n_loops, const int64_t *waited, const int64_t *ended, int64_t now);
/* Records losses of loops on teams, times in nanoseconds, and returns how long a loop that begins now runs on the calling thread
 * alone. */
int64_t time_alone_after(int n_loops, const int64_t *lost, const int64_t *ended, int64_t now);
/* Returns whether the calling thread runs all blocks of a loop on a team that is shorter than the recorded losses. */
int caller_begins_alone(void);
/* Returns whether a second thread takes part in a longer loop, after the calling thread has run some blocks alone. */
int caller_calls_a_team_later(void);
/* Runs a loop and returns whether it ran on a team. */
int next_loop_is_on_a_team(void);
/* Returns whether a loop with more threads than the machine has processors runs on a team. */
int too_many_threads_are_a_team(void);
/* Runs a loop of OpenMP in which the calling thread waits 100 ms for the other thread. Returns whether the next loop runs on a
 * team. */
int wait_long_for_a_thread(void);
/* Starts n_callers threads. Each runs n_loops loops with 1 to 4 threads, three of four on teams. Returns 1 if all loops are
 * correct. */
int loops_at_once(int n_callers, int n_loops);
/* Runs a loop on two threads inside a parallel region of the caller, which may nest n_levels regions. Returns how many threads
 * each loop had, or -1. */
int loop_in_a_region(int n_levels);

typedef struct loop_threads {
  int takes_signals;       /* the second thread does not block SIGALRM */
  int takes_error_signals; /* the second thread does not block SIGSEGV */
} loop_threads;
/* Returns what the second thread of a team does with signals. */
loop_threads threads_of_a_loop(void);

/* A handler of a signal delays the second thread of a team. No earlier loop may have used more than two threads. Runs n_loops
 * loops on two threads, which must end meanwhile, and then releases the thread. Returns 1 if all loops are correct, if the
 * calling thread did all their work, and if the second thread then takes part again. */
int loops_while_a_thread_is_held(int n_loops);

#ifdef __cplusplus
}
#endif

#endif
