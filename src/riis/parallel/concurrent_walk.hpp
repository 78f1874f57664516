// SPDX-License-Identifier: Apache-2.0
// Loops whose bodies add more work. Only this file, arena.hpp and arena_pool.* use TBB.
#pragma once

#if defined(RIIS_STD_THREADS)
#include "parallel/walk_by_threads.hpp"
#else

#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstdint>
#include <vector>

#include "common/float_environment.hpp"
#include "parallel/arena.hpp"
#include "parallel/range.hpp"
#include "parallel/threads.hpp"

namespace riis {

// Runs body(range, add, thread) for every range of the list, and for every range that a body adds by add(range). Up to n_threads
// threads run bodies in no particular order, 0 <= thread < n_threads. Returns how many threads ran. Rethrows the first
// exception. A walk may start anywhere in the caller's program: the caller's parallel regions, tasks, settings and limits stay
// as they are. With n_threads = 1 the calling thread runs all bodies without TBB and empties the list.
template <class Body>
int concurrent_walk(std::vector<Range> &ranges, int n_threads, const Body &body) {
  if (n_threads == 1 || !begin_threads()) {
    while (!ranges.empty()) {
      const Range range = ranges.back();
      ranges.pop_back();
      body(
          range, [&](const Range &more) { ranges.push_back(more); }, 0);
    }
    return 1;
  }
  std::atomic<std::uint64_t> ran[16] = {};  // a bit for each thread, up to 1024
  Arena arena(n_threads);
  arena.run([&] {
    tbb::parallel_for_each(ranges.begin(), ranges.end(), [&](const Range &range, tbb::feeder<Range> &feeder) {
      const FloatEnvironment environment;
      const int thread = tbb::this_task_arena::current_thread_index();
      ran[thread / 64].fetch_or(std::uint64_t{1} << thread % 64, std::memory_order_relaxed);
      body(
          range, [&](const Range &more) { feeder.add(more); }, thread);
    });
  });
  int n_ran = 0;
  for (const auto &bits : ran) n_ran += __builtin_popcountll(bits.load(std::memory_order_relaxed));
  return n_ran < 1 ? 1 : n_ran;
}

}  // namespace riis

#endif
