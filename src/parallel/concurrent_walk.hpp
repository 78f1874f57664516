// SPDX-License-Identifier: Apache-2.0
// The seam through which work that makes more work goes; it and arena_pool.* are the only files that name TBB.
#pragma once

#if defined(RIIS_STD_THREADS)
#include "parallel/walk_by_threads.hpp"
#else

#include <tbb/global_control.h>
#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/float_environment.hpp"
#include "parallel/arena_pool.hpp"
#include "parallel/range.hpp"

namespace riis {

// An arena of up to n_threads threads, the calling one among them, lent by the pool for as long as this lives. TBB gives no more
// threads than it may have in the process: where that is fewer it may have more for as long as this lives, unless it was the
// caller who said so. An arena of more than there can be would be announced on stderr.
class Arena {
 public:
  explicit Arena(int n_threads) {
    const auto wanted = static_cast<std::size_t>(n_threads);
    if (allowed() < wanted) limit_.emplace(tbb::global_control::max_allowed_parallelism, wanted);
    lent_ = borrow_arena(static_cast<int>(std::min(allowed(), wanted)));
  }
  ~Arena() { give_back(lent_); }
  Arena(const Arena &) = delete;
  Arena &operator=(const Arena &) = delete;

  template <class Work>
  void run(const Work &work) {
    lent_->arena.execute(work);
  }

 private:
  static std::size_t allowed() {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  }

  std::optional<tbb::global_control> limit_;
  PooledArena *lent_;
};

// Runs body(range, add, thread) for every range of the list and for all that bodies add, add(range), on up to n_threads threads, 0
// <= thread < n_threads, in no particular order. Returns how many threads ran. The first exception is thrown again here. Starts
// anew from anywhere: a caller's parallel regions and tasks, settings and limits stay as they are. One thread is the calling one,
// without TBB, and the list is used up.
template <class Body>
int concurrent_walk(std::vector<Range> &ranges, int n_threads, const Body &body) {
  if (n_threads == 1) {
    while (!ranges.empty()) {
      const Range range = ranges.back();
      ranges.pop_back();
      body(
          range, [&](const Range &more) { ranges.push_back(more); }, 0);
    }
    return 1;
  }
  std::atomic<std::uint64_t> ran[16] = {};  // a bit a thread, of up to 1024
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
