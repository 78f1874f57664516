// SPDX-License-Identifier: Apache-2.0
// The threads of loops. Between loops they wait, first awake and then asleep. A loop does not wait for a thread that another
// process keeps from coming: the calling thread then does the work.
#pragma once

namespace riis {

// Calls work(context, 0) on the calling thread. Calls work(context, thread), 0 < thread < n_threads, on each further thread that
// comes before the call on the calling thread has returned. Returns after all these calls have returned. The result is the number
// of threads that were called, which is less than n_threads only if the system refuses a thread. No call may throw.
int run_by_team(int n_threads, void (*work)(void *context, int thread), void *context);

}  // namespace riis
