// SPDX-License-Identifier: Apache-2.0
#include "arenas.h"

#include <tbb/parallel_for.h>

#define TBB_PREVIEW_WAITING_FOR_WORKERS 1
#include <tbb/global_control.h>

#include <array>
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

#include "parallel/concurrent_walk.hpp"
#include "parallel/threads.hpp"

namespace {

constexpr std::size_t n_first = 32;

// Makes a walk in which each body calls at_body.
template <class AtBody>
walk_seen walk(int n_threads, const AtBody &at_body) {
  std::array<std::atomic<int>, 2 * n_first> n_met{};
  std::atomic<int> least{1 << 20}, most{0};
  std::vector<riis::Range> ranges;
  for (std::size_t i = 0; i < n_first; ++i)
    ranges.push_back({static_cast<std::int64_t>(i), static_cast<std::int64_t>(i) + 1});
  std::atomic<bool> is_right{true};
  const int n_ran =
      riis::concurrent_walk(ranges, n_threads, [&](const riis::Range &range, const auto &add, int thread) {
        if (thread < 0 || thread >= n_threads) is_right = false;
        const int of_arena = tbb::this_task_arena::max_concurrency();
        for (int now = least; now > of_arena && !least.compare_exchange_weak(now, of_arena);) {
        }
        for (int now = most; now < of_arena && !most.compare_exchange_weak(now, of_arena);) {
        }
        ++n_met[static_cast<std::size_t>(range.begin)];
        if (range.begin < static_cast<std::int64_t>(n_first))
          add(riis::Range{range.begin + static_cast<std::int64_t>(n_first),
                          range.end + static_cast<std::int64_t>(n_first)});
        at_body();
      });
  for (const auto &n : n_met)
    if (n != 1) is_right = false;
  return {is_right && n_ran >= 1 && n_ran <= n_threads, least == most ? most.load() : -1};
}

}  // namespace

struct arenas_keeper {
  riis::KeepsArenas keeps_arenas;
};

arenas_keeper *arenas_keep() { return new arenas_keeper; }

void arenas_let_go(arenas_keeper **keeper) {
  delete *keeper;
  *keeper = nullptr;
}

int arenas_made() { return static_cast<int>(riis::n_arenas()); }

walk_seen walk_once(int n_threads) {
  return walk(n_threads, [] {});
}

walk_seen walk_under_limit(int limit, int n_threads) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(limit));
  return walk_once(n_threads);
}

int walk_that_throws(int n_threads) {
  std::vector<riis::Range> ranges(n_first, riis::Range{0, 1});
  try {
    riis::concurrent_walk(ranges, n_threads, [](const riis::Range &, const auto &, int) { throw 7; });
  } catch (int thrown) {
    return thrown == 7;
  }
  return 0;
}

int walk_at_once(int n_callers, int n_walks) {
  std::atomic<int> n_in_bodies{0};
  std::atomic<bool> is_right{true};
  std::vector<std::thread> callers;
  for (int caller = 0; caller < n_callers; ++caller)
    callers.emplace_back([&, caller] {
      std::atomic<bool> is_first{true};
      const auto meet_the_others = [&] {
        if (!is_first.exchange(false)) return;
        ++n_in_bodies;
        while (n_in_bodies < n_callers) std::this_thread::yield();
      };
      if (!walk(2, meet_the_others).is_right) is_right = false;
      for (int i = 1; i < n_walks; ++i)
        if (!walk_once(2 + (caller + i) % 2).is_right) is_right = false;
    });
  for (std::thread &caller : callers) caller.join();
  return is_right;
}

int walk_in_tasks(int n_tasks) {
  std::atomic<bool> is_right{true};
  const tbb::global_control allow_four(tbb::global_control::max_allowed_parallelism, 4);
  tbb::task_arena arena(4);
  arena.execute([&] {
    tbb::parallel_for(0, n_tasks, [&](int) {
      const int before = tbb::this_task_arena::max_concurrency();
      if (!walk_once(2).is_right || tbb::this_task_arena::max_concurrency() != before) is_right = false;
    });
  });
  return is_right;
}

int end_tbb() {
  tbb::task_scheduler_handle handle{tbb::attach{}};
  return tbb::finalize(handle, std::nothrow);
}
