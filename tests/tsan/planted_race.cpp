// SPDX-License-Identifier: Apache-2.0
// planted_race loop|openmp|walk race|order: runs the library's parallel loop on its own threads or on OpenMP's, or its walk. With
// `race`, the thread sanitizer must report a race between the bodies. With `order`, the loop or walk orders the accesses, and the
// sanitizer must be silent. Exit status 3 means that only one thread took part, so the run shows nothing.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>

#include "parallel/concurrent_walk.hpp"
#include "parallel/parallel_for.hpp"

namespace {

// The report of the sanitizer must name `planted`. The variable has a separate cache line, away from the often-used flags,
// because the sanitizer remembers few accesses to each eight bytes.
alignas(64) int planted = 0;
alignas(64) std::atomic<int> n_come{0};
std::atomic<bool> is_written{false}, is_written_again{false};

// Waits by relaxed loads, which order nothing. The function makes few loads, because many loads would push the other access out
// of the thread's history. If the other thread never comes, the function returns after a while.
template <class Happened>
bool wait_until(const Happened &happened) {
  const auto start = std::chrono::steady_clock::now();
  while (!happened()) {
    if (std::chrono::steady_clock::now() - start > std::chrono::seconds(30)) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

// This function is called four times, twice on each of two threads. Both threads reach their first call, and one thread writes in
// this call. The other thread writes in its second call, long after the first thread's call has returned. The writes therefore
// never overlap. Only an order between bodies, which the library does not promise, could hide the race.
void write_late() {
  thread_local int n_calls = 0, place = 0;
  ++n_calls;
  if (n_calls == 1) {
    place = n_come.fetch_add(1, std::memory_order_relaxed);
    wait_until([] { return n_come.load(std::memory_order_relaxed) == 2; });
    if (place == 0) {
      ++planted;
      is_written.store(true, std::memory_order_relaxed);
    } else {
      wait_until([] { return is_written.load(std::memory_order_relaxed); });
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  } else if (place == 0) {
    wait_until([] { return is_written_again.load(std::memory_order_relaxed); });
  } else {
    ++planted;
    is_written_again.store(true, std::memory_order_relaxed);
  }
}

bool race_in_loop() {
  riis::parallel_for(4, 2, [](std::int64_t, int) { write_late(); });
  return is_written_again;
}

bool race_in_openmp() {
  riis::openmp_for(4, 2, [](std::int64_t, int) { write_late(); });
  return is_written_again;
}

bool race_in_walk() {
  riis::concurrent_walk({{0, 1}, {1, 2}, {2, 3}, {3, 4}}, 2,
                        [](const riis::Range &, const auto &, int) { write_late(); });
  return is_written_again;
}

// Each loop writes where another thread may have written in the previous loop.
template <class Loop>
bool order_in(const Loop &loop) {
  static int written[1000];
  int n_ran = 0;
  for (int repeat = 0; repeat < 50; ++repeat)
    n_ran = loop([&](std::int64_t i, int) { ++written[(7 * i + repeat) % 1000]; });
  return n_ran == 2 && written[0] == 50;
}

bool order_in_loop() {
  return order_in([](const auto &body) { return riis::parallel_for(1000, 2, body); });
}

bool order_in_openmp() {
  return order_in([](const auto &body) { return riis::openmp_for(1000, 2, body); });
}

// If a body adds another body, the added body runs after its adder's earlier writes, on either thread. The first body waits until
// the other thread goes on.
bool order_in_walk() {
  static int written[1000];
  std::atomic<int> n_on_thread[2] = {};
  riis::concurrent_walk({{0, 1000}}, 2, [&](const riis::Range &range, const auto &add, int thread) {
    n_on_thread[thread].fetch_add(1, std::memory_order_relaxed);
    if (range.begin > 0) ++written[range.begin - 1];
    ++written[range.begin];
    if (range.begin + 1 < range.end) add({range.begin + 1, range.end});
    if (range.begin == 0) wait_until([&] { return n_on_thread[1 - thread].load(std::memory_order_relaxed) > 0; });
  });
  return n_on_thread[0] > 0 && n_on_thread[1] > 0 && written[0] == 2;
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 3) return 2;
  const bool in_loop = std::strcmp(argv[1], "loop") == 0, in_openmp = std::strcmp(argv[1], "openmp") == 0;
  const bool is_race = std::strcmp(argv[2], "race") == 0;
  const auto race = in_loop ? race_in_loop : in_openmp ? race_in_openmp : race_in_walk;
  const auto order = in_loop ? order_in_loop : in_openmp ? order_in_openmp : order_in_walk;
  const auto run = is_race ? race : order;
  const bool two_took_part = run();
  std::printf("%s; written %d times\n", two_took_part ? "two threads took part" : "no two threads took part", planted);
  return two_took_part ? 0 : 3;
}
