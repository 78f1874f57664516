// SPDX-License-Identifier: Apache-2.0
// Every parallel loop goes through this file. No other file names OpenMP.
#pragma once

#include <omp.h>

#include <atomic>
#include <cstdint>
#include <exception>

#include "common/float_environment.hpp"
#include "parallel/range.hpp"
#include "parallel/threads.hpp"

namespace riis {

// Returns the number of processors that the calling thread may use, by its affinity mask; n_threads = 0 takes no more.
// If OpenMP itself binds threads to places, the mask is the one with which the process started.
inline int default_thread_count() noexcept {
  const int n = omp_get_num_procs();
  return n < 1 ? 1 : n;
}

// By default a call takes one more thread for each such amount of work, half a millisecond or more. Waking and awaiting a
// thread takes a hundredth of that on a quiet machine. On a busy one it takes as long as the system lets other work run.
constexpr std::int64_t triangles_per_thread = 4096, points_per_thread = 2048;
constexpr std::int64_t nodes_per_thread = 16384;  // of a mesh, its cells or faces

// Returns the number of threads that a caller requests or, if it is 0, the number that n_items of work feed.
inline Threads threads_for(std::int32_t n_threads, std::int64_t n_items, std::int64_t per_thread) {
  return n_threads > 0 ? Threads(n_threads)
                       : Threads::by_default(n_items, per_thread, has_lost_threads() ? 1 : default_thread_count());
}

// Runs body(block, thread) once for every block in [0, n_blocks) on up to n_threads threads, and returns how many threads ran.
// Blocks are handed out in ascending order, so each thread sees ascending block numbers. After all threads have stopped, the
// exception of the lowest block is thrown again here. A single thread meets the same exception, because all blocks before it were
// handed out before it and run to their end. No setting of the caller's OpenMP changes. Inside a caller's parallel region, the
// loop runs on as many threads as nesting allows. One thread means the calling thread without OpenMP, whose run-time ends the
// process if it has no memory. A loop of fewer blocks than threads leaves some threads idle: GCC's run-time ends the threads that
// a smaller team leaves out, and the next loop waits for new ones.
template <class Body>
int parallel_for(std::int64_t n_blocks, int n_threads, const Body &body) {
  if (n_blocks <= 1 || (n_threads > 1 && !begin_threads())) n_threads = 1;
  if (n_threads == 1) {
    for (std::int64_t block = 0; block < n_blocks; ++block) body(block, 0);
    return 1;
  }
  std::atomic<std::int64_t> next_block{0};
  std::exception_ptr first_exception;
  std::int64_t first_to_fail = n_blocks;
  int n_ran = 1;
#pragma omp parallel num_threads(n_threads) default(none) \
    shared(n_blocks, body, next_block, first_exception, first_to_fail, n_ran)
  {
    const FloatEnvironment environment;
    const int thread = omp_get_thread_num();
    if (thread == 0) n_ran = omp_get_num_threads();
    std::int64_t block = 0;
    try {
      while ((block = next_block.fetch_add(1, std::memory_order_relaxed)) < n_blocks) body(block, thread);
    } catch (...) {
      next_block.store(n_blocks, std::memory_order_relaxed);
#pragma omp critical(riis_first_exception)
      {
        if (block < first_to_fail) {
          first_to_fail = block;
          first_exception = std::current_exception();
        }
      }
    }
  }
  if (first_exception) std::rethrow_exception(first_exception);
  return n_ran;
}

// Does the same over [0, n) in ranges of per_block, the last one possibly shorter, with body(range, thread).
template <class Body>
int parallel_for_ranges(std::int64_t n, std::int64_t per_block, int n_threads, const Body &body) {
  return parallel_for((n + per_block - 1) / per_block, n_threads, [&](std::int64_t block, int thread) {
    const std::int64_t begin = block * per_block;
    body(Range{begin, begin + per_block < n ? begin + per_block : n}, thread);
  });
}

}  // namespace riis
