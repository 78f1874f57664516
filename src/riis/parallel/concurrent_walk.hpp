// SPDX-License-Identifier: Apache-2.0
// Loops over a list of work to which the loop's body may add more work. Only this file, arena.hpp and arena_pool.* use TBB.
#pragma once

#if defined(RIIS_STD_THREADS)
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "common/array_view.hpp"
#include "common/float_environment.hpp"
#include "parallel/threads.hpp"

// Implements concurrent_walk with standard threads for the thread sanitizer, which does not understand TBB. This version
// guarantees only the order that TBB guarantees: a range runs after the call of add() that added it, and the walk ends after all
// its ranges. All other counts use relaxed atomics, which impose no order. A lock around a common queue would put the bodies in
// order, and thus hide their races from the sanitizer.
namespace riis {

// An array of slots for any number of ranges. The address of a slot never changes.
class RangeSlots {
 public:
  struct Slot {
    std::atomic<bool> is_filled{false};
    Range range;
  };

  RangeSlots() = default;
  RangeSlots(const RangeSlots &) = delete;
  RangeSlots &operator=(const RangeSlots &) = delete;
  ~RangeSlots() {
    for (const auto &chunk : chunks_) delete[] chunk.load();
  }

  // Chunk c has first_size << c slots.
  Slot &operator[](std::int64_t i) {
    const int c = 63 - __builtin_clzll(static_cast<unsigned long long>(i / first_size + 1));
    std::atomic<Slot *> &chunk = view(chunks_)[c];
    Slot *slots = chunk.load(std::memory_order_acquire);
    if (!slots) {
      auto *const made = new Slot[static_cast<std::size_t>(first_size << c)];
      if (chunk.compare_exchange_strong(slots, made, std::memory_order_acq_rel))
        slots = made;
      else
        delete[] made;
    }
    return slots[i - first_size * ((std::int64_t{1} << c) - 1)];
  }

 private:
  static constexpr std::int64_t first_size = 1024;
  std::array<std::atomic<Slot *>, 40> chunks_{};
};

template <class Body>
int concurrent_walk(const std::vector<Range> &ranges, int n_threads, const Body &body) {
  if (n_threads > 1 && !begin_threads()) n_threads = 1;
  RangeSlots slots;
  std::atomic<std::int64_t> n_added{0}, n_taken{0}, n_left{0};
  std::atomic<int> n_ran{0};
  std::atomic<bool> has_failed{false};
  std::mutex mutex;
  std::exception_ptr first_exception;
  const auto add = [&](const Range &range) {
    n_left.fetch_add(1, std::memory_order_relaxed);
    RangeSlots::Slot &slot = slots[n_added.fetch_add(1, std::memory_order_relaxed)];
    slot.range = range;
    slot.is_filled.store(true, std::memory_order_release);
  };
  const auto work = [&](int thread) {
    const FloatEnvironment environment;
    bool is_counted = false;
    for (;;) {
      RangeSlots::Slot &slot = slots[n_taken.fetch_add(1, std::memory_order_relaxed)];
      while (!slot.is_filled.load(std::memory_order_acquire)) {
        if (n_left.load(std::memory_order_relaxed) == 0) return;
        std::this_thread::sleep_for(std::chrono::microseconds(20));  // a busy wait would fill the sanitizer's history
      }
      if (!is_counted) n_ran.fetch_add(1, std::memory_order_relaxed);
      is_counted = true;
      try {
        if (!has_failed.load(std::memory_order_relaxed)) body(slot.range, add, thread);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!first_exception) first_exception = std::current_exception();
        has_failed.store(true, std::memory_order_relaxed);
      }
      n_left.fetch_sub(1, std::memory_order_relaxed);
    }
  };
  for (const Range &range : ranges) add(range);
  std::vector<std::thread> threads;
  for (int thread = 1; thread < n_threads; ++thread) threads.emplace_back(work, thread);
  work(0);
  for (std::thread &thread : threads) thread.join();
  if (first_exception) std::rethrow_exception(first_exception);
  return std::max(n_ran.load(), 1);
}

}  // namespace riis

#else

#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstdint>
#include <vector>

#include "common/float_environment.hpp"
#include "parallel/arena.hpp"
#include "parallel/threads.hpp"

namespace riis {

// Runs body(range, add, thread) for every range of the list, and for every range that a body adds by add(range). Up to n_threads
// threads run bodies in no particular order, 0 <= thread < n_threads. Returns how many threads ran. Rethrows the first
// exception. A walk may start anywhere in the caller's program. The caller's parallel regions, tasks, settings and limits stay
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
