// SPDX-License-Identifier: Apache-2.0
// Loops over a fixed number of blocks. No other file uses OpenMP.
#pragma once

#include <omp.h>

#include <atomic>
#include <cstdint>
#include <exception>

#include "common/float_environment.hpp"
#include "parallel/range.hpp"
#include "parallel/threads.hpp"

namespace riis {

// Returns the number of processors in the affinity mask of the calling thread. n_threads = 0 never stands for more threads. If
// OpenMP binds threads to places, the mask is that of the process at its start.
inline int default_thread_count() noexcept {
  const int n = omp_get_num_procs();
  return n < 1 ? 1 : n;
}

// By default a call uses one more thread for each of these amounts of work, which take half a millisecond or more. On a quiet
// machine, waking a thread and waiting for it takes a hundredth of that time. On a busy machine it takes as long as the system
// lets other processes run.
constexpr std::int64_t triangles_per_thread = 4096, points_per_thread = 2048;
constexpr std::int64_t nodes_per_thread = 16384;  // nodes of a mesh, or cells or faces

// Returns the number of threads that a caller requests. If it is 0, returns the number that n_items of work keep busy.
inline Threads threads_for(std::int32_t n_threads, std::int64_t n_items, std::int64_t per_thread) {
  return n_threads > 0 ? Threads(n_threads)
                       : Threads::by_default(n_items, per_thread, has_lost_threads() ? 1 : default_thread_count());
}

// Runs body(block, thread) once for every block in [0, n_blocks) on up to n_threads threads, and returns how many threads ran.
// Blocks are handed out in ascending order, so each thread sees ascending block numbers. If bodies throw, all threads stop, and
// then the exception of the lowest block is rethrown. It is the exception that a single thread would meet, because all lower
// blocks were handed out earlier and ran to their end.
// The caller's OpenMP settings do not change. Inside a caller's parallel region, the loop uses as many threads as nesting
// allows. With one thread, the calling thread runs the loop without OpenMP, whose run-time ends the process if it has no memory.
// If there are fewer blocks than threads, some threads stay idle. A smaller team would be slower: GCC's run-time ends the
// threads that are left out, and the next loop has to wait for new ones.
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

// Runs body(range, thread) for [0, n) in ranges of per_block, as the loop over blocks does. The last range may be shorter.
template <class Body>
int parallel_for_ranges(std::int64_t n, std::int64_t per_block, int n_threads, const Body &body) {
  return parallel_for((n + per_block - 1) / per_block, n_threads, [&](std::int64_t block, int thread) {
    const std::int64_t begin = block * per_block;
    body(Range{begin, begin + per_block < n ? begin + per_block : n}, thread);
  });
}

}  // namespace riis
