// SPDX-License-Identifier: Apache-2.0
#include "tbb_region.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <optional>
#include <thread>

namespace {

constexpr auto threads_allowed = tbb::global_control::max_allowed_parallelism;

struct Settings {
  std::size_t allowed = tbb::global_control::active_value(threads_allowed);
  int arena = tbb::this_task_arena::max_concurrency();
};

int changed_since(const Settings &before) {
  const Settings now;
  return (now.allowed != before.allowed) + (now.arena != before.arena);
}

}  // namespace

tbb_seen tbb_run(int region, int n_tasks, void (*body)(void *data, int task), void *data) {
  std::atomic<int> n_changed{0}, n_begun{0}, n_running{0}, most_at_once{0};
  const auto loop = [&] {
    const Settings before;
    tbb::parallel_for(
        tbb::blocked_range<int>(0, n_tasks, 1),
        [&](const tbb::blocked_range<int> &range) {
          const int running = ++n_running, arena = tbb::this_task_arena::max_concurrency();
          for (int most = most_at_once; most < running && !most_at_once.compare_exchange_weak(most, running);) {
          }
          ++n_begun;
          const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
          while (region == TBB_ARENA_OF_FOUR && n_begun < 2 && std::chrono::steady_clock::now() < end) {
            std::this_thread::yield();
          }
          for (int task = range.begin(); task < range.end(); ++task) body(data, task);
          // The whole process has one limit on TBB's threads, so calls of other tasks may have raised it meanwhile.
          n_changed += tbb::this_task_arena::max_concurrency() != arena;
          --n_running;
        },
        tbb::simple_partitioner());
    n_changed += changed_since(before);
  };
  const Settings before;
  {
    std::optional<tbb::global_control> limit;
    if (region == TBB_ARENA_OF_FOUR) limit.emplace(threads_allowed, std::size_t{4});
    if (region == TBB_LIMIT_OF_ONE) limit.emplace(threads_allowed, std::size_t{1});
    if (region == TBB_ARENA_OF_FOUR || region == TBB_ARENA_OF_ONE) {
      tbb::task_arena arena(region == TBB_ARENA_OF_ONE ? 1 : 4);
      arena.execute(loop);
    } else {
      loop();
    }
  }
  n_changed += changed_since(before);
  return {n_changed, most_at_once};
}
