// SPDX-License-Identifier: Apache-2.0
#include "loops.h"

#include <omp.h>
#include <pthread.h>
#include <signal.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>
#include <vector>

#include "parallel/parallel_for.hpp"

using namespace riis;

namespace {

struct Seen {
  bool is_right = true;
  int n_ran = 0;
  std::int64_t n_of_caller = 0;  // number of blocks that the calling thread ran
};

// If `choice` is given, the loop runs on a team.
Seen run_loop(std::int64_t n_blocks, int n_threads, LoopChoice *choice = nullptr) {
  struct Thread {
    std::int64_t last = -1;
    int n_descents = 0;
    std::atomic<int> n_inside{0};
  };
  std::vector<std::atomic<int>> n_runs(static_cast<std::size_t>(n_blocks));
  std::vector<Thread> threads(static_cast<std::size_t>(n_threads));
  std::atomic<bool> is_right{true};
  std::atomic<std::int64_t> n_of_caller{0};
  const std::thread::id caller = std::this_thread::get_id();
  Seen seen;
  const auto body = [&](std::int64_t block, int number) {
    const bool is_caller = std::this_thread::get_id() == caller;
    if (number < 0 || number >= n_threads || (number == 0) != is_caller) {
      is_right = false;
      return;
    }
    Thread &thread = threads[static_cast<std::size_t>(number)];
    // After its own share, a thread goes on to the next shares. The order of shares is cyclic: the first share follows the last
    // share.
    thread.n_descents += block < thread.last;
    if (thread.n_inside.fetch_add(1) != 0 || block == thread.last || thread.n_descents > (number == 0 ? 0 : 1))
      is_right = false;
    thread.last = block;
    n_runs[static_cast<std::size_t>(block)].fetch_add(1, std::memory_order_relaxed);
    if (is_caller) n_of_caller.fetch_add(1, std::memory_order_relaxed);
    thread.n_inside.fetch_sub(1);
  };
  seen.n_ran = choice ? team_for(n_blocks, n_threads, body, *choice) : parallel_for(n_blocks, n_threads, body);
  for (const std::atomic<int> &n : n_runs)
    if (n.load(std::memory_order_relaxed) != 1) is_right = false;
  seen.is_right = is_right && seen.n_ran >= 1 && seen.n_ran <= n_threads;
  seen.n_of_caller = n_of_caller;
  return seen;
}

void wait_for(const std::atomic<int> &number, int value) {
  while (number.load() < value) std::this_thread::sleep_for(std::chrono::microseconds(100));
}
void wait_a_second_for(const std::atomic<int> &number, int value) {
  for (int i = 0; i < 10'000 && number.load() < value; ++i) std::this_thread::sleep_for(std::chrono::microseconds(100));
}

// Runs a loop of two blocks on a team of two threads. Each thread must run one block. The second thread calls look().
template <class Look>
void run_on_both_threads(const Look &look) {
  std::atomic<int> n_come{0};
  LoopChoice choice;
  team_for(
      2, 2,
      [&](std::int64_t, int thread) {
        n_come.fetch_add(1);
        wait_for(n_come, 2);
        if (thread == 1) look();
      },
      choice);
}

std::atomic<int> is_held{0}, is_released{0};

void hold(int) {
  is_held = 1;
  while (is_released == 0) {
    const timespec brief{0, 100'000};
    nanosleep(&brief, nullptr);
  }
}

}  // namespace

int loop_once(int64_t n_blocks, int n_threads) {
  const Seen seen = run_loop(n_blocks, n_threads);
  return seen.is_right ? seen.n_ran : -1;
}

namespace {

// A loop whose bodies count their runs. A body may throw the number of its block.
struct FailingLoop {
  explicit FailingLoop(std::int64_t n_blocks) : n_runs(static_cast<std::size_t>(n_blocks)) {}

  void begin(std::int64_t block) { n_runs[static_cast<std::size_t>(block)].fetch_add(1, std::memory_order_relaxed); }
  // Returns the block whose exception leaves run(), or the number of blocks if no exception leaves it. Returns -1 if a block did
  // not run before the first failing block, or if a block ran twice.
  template <class Run>
  std::int64_t caught(const Run &run) const {
    const auto n_blocks = static_cast<std::int64_t>(n_runs.size());
    std::int64_t caught = n_blocks;
    try {
      run();
    } catch (std::int64_t block) {
      caught = block;
    }
    for (std::int64_t block = 0; block < n_blocks; ++block) {
      const int n = n_runs[static_cast<std::size_t>(block)];
      if (n > 1 || (block < caught && n == 0)) return -1;
    }
    return caught;
  }

  std::vector<std::atomic<int>> n_runs;  // of each block
};

}  // namespace

int64_t block_whose_exception_comes(int64_t n_blocks, int n_threads, int64_t n_failing, const int64_t *failing,
                                    int on_a_team) {
  FailingLoop loop(n_blocks);
  const std::int64_t *const end = failing + n_failing;
  const auto body = [&](std::int64_t block, int) {
    loop.begin(block);
    if (std::find(failing, end, block) != end) throw block;
  };
  LoopChoice choice;
  return loop.caught(
      [&] { on_a_team ? team_for(n_blocks, n_threads, body, choice) : openmp_for(n_blocks, n_threads, body); });
}

int64_t block_that_fails_first(int64_t n_blocks, int64_t also_failing, int64_t *n_higher) {
  FailingLoop loop(n_blocks);
  std::atomic<int> has_failed{0};
  std::atomic<bool> begins_with_own_share{true};
  const std::int64_t first_of_second = n_blocks / 2;
  const auto body = [&](std::int64_t block, int thread) {
    loop.begin(block);
    if (thread == 1 && has_failed == 0) {
      if (block != first_of_second) begins_with_own_share = false;
      has_failed = 1;
      throw block;
    }
    if (block == 0) {
      wait_for(has_failed, 1);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));  // the exception is thrown but not yet caught
    }
    if (block == also_failing) throw block;
  };
  LoopChoice choice;
  const std::int64_t caught = loop.caught([&] { team_for(n_blocks, 2, body, choice); });
  *n_higher = 0;
  for (std::int64_t block = caught + 1; block < n_blocks; ++block)
    *n_higher += loop.n_runs[static_cast<std::size_t>(block)] > 0;
  return begins_with_own_share ? caught : -1;
}

int team_loop_once(int64_t n_blocks, int n_threads) {
  LoopChoice choice;
  const Seen seen = run_loop(n_blocks, n_threads, &choice);
  return seen.is_right ? seen.n_ran : -1;
}

int choice_after(int n_loops, const int64_t *waited, const int64_t *ended, int64_t now) {
  LoopChoice choice;
  for (int i = 0; i < n_loops; ++i) choice.record(waited[i], ended[i]);
  return choice.takes_team(now);
}

int64_t time_alone_after(int n_loops, const int64_t *lost, const int64_t *ended, int64_t now) {
  LoopChoice choice;
  for (int i = 0; i < n_loops; ++i) choice.record_team(lost[i], ended[i]);
  return choice.time_alone(now);
}

int caller_begins_alone() {
  LoopChoice choice;
  choice.record_team(std::int64_t{16} * 3600 * 1'000'000'000, nanoseconds());  // the caller works alone for an hour
  const Seen seen = run_loop(1000, 4, &choice);
  return seen.is_right && seen.n_ran == 4 && seen.n_of_caller == 1000;
}

int caller_calls_a_team_later() {
  LoopChoice choice;
  choice.record_team(std::int64_t{16} * 20'000'000, nanoseconds());  // the caller works alone for 20 ms
  std::atomic<int> n_come{0}, n_alone{0};
  team_for(
      1'000'000, 2,
      [&](std::int64_t, int thread) {
        if (n_come >= 2) return;
        // The calling thread works alone until a second thread comes, and then both threads wait for each other.
        if (thread == 1 || n_alone.load() >= 10) {
          n_come.fetch_add(1);
          wait_for(n_come, 2);
        } else {
          n_alone.fetch_add(1);
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
      },
      choice);
  return n_come >= 2 && n_alone > 0;
}

namespace {

bool is_on_a_team(int n_threads) {
  bool are_openmps = true;
  parallel_for(2, n_threads, [&](std::int64_t block, int) {
    if (block == 0) are_openmps = omp_in_parallel() != 0;
  });
  return !are_openmps;
}

}  // namespace

int next_loop_is_on_a_team() { return is_on_a_team(2); }

int too_many_threads_are_a_team() { return is_on_a_team(processors_of_machine() + 1); }

int wait_long_for_a_thread() {
#if defined(RIIS_STD_THREADS)
  return next_loop_is_on_a_team();  // every loop runs on a team, so no wait chooses a team
#endif
  // On a busy machine, an earlier wait may have put all loops on teams for up to 2 seconds. The calling thread of a team may run
  // both blocks, so the loop is repeated until no team runs it.
  for (bool are_openmps = false; !are_openmps;) {
    std::atomic<int> n_come{0};
    parallel_for(2, 2, [&](std::int64_t, int thread) {
      n_come.fetch_add(1);
      wait_a_second_for(n_come, 2);
      if (thread == 0) are_openmps = omp_in_parallel() != 0;
      if (thread == 1) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    });
  }
  return next_loop_is_on_a_team();
}

int loops_at_once(int n_callers, int n_loops) {
  std::atomic<bool> are_right{true};
  LoopChoice choice;
  std::vector<std::thread> callers;
  for (int caller = 0; caller < n_callers; ++caller)
    callers.emplace_back([&, caller] {
      for (int i = 0; i < n_loops; ++i)
        if (!run_loop(1 + (7 * i + caller) % 50, 1 + (i + caller) % 4, i % 4 != 0 ? &choice : nullptr).is_right)
          are_right = false;
    });
  for (std::thread &caller : callers) caller.join();
  return are_right;
}

int loop_in_a_region(int n_levels) {
  const int n_levels_before = omp_get_max_active_levels();
  omp_set_max_active_levels(n_levels);
  int n_ran[2] = {0, 0};
#pragma omp parallel num_threads(2)
  n_ran[omp_get_thread_num()] = loop_once(100, 2);
  omp_set_max_active_levels(n_levels_before);
  return n_ran[0] == n_ran[1] ? n_ran[0] : -1;
}

loop_threads threads_of_a_loop() {
  loop_threads seen{};
  run_on_both_threads([&] {
    sigset_t blocked;
    pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
    seen = {sigismember(&blocked, SIGALRM) == 0, sigismember(&blocked, SIGSEGV) == 0};
  });
  return seen;
}

int loops_while_a_thread_is_held(int n_loops) {
  pthread_t second = pthread_self(), second_again = pthread_self();
  run_on_both_threads([&] { second = pthread_self(); });
  struct sigaction action = {}, before = {};
  action.sa_handler = hold;
  if (sigaction(SIGTRAP, &action, &before) != 0) return 0;
  is_held = is_released = 0;
  if (pthread_kill(second, SIGTRAP) != 0) return 0;
  wait_for(is_held, 1);
  bool are_right = true;
  for (int i = 0; i < n_loops; ++i) {
    LoopChoice choice;
    const Seen seen = run_loop(100, 2, &choice);
    are_right = are_right && seen.is_right && seen.n_ran == 2 && seen.n_of_caller == 100;
  }
  is_released = 1;
  run_on_both_threads([&] { second_again = pthread_self(); });
  sigaction(SIGTRAP, &before, nullptr);
  return are_right && pthread_equal(second, second_again);
}
