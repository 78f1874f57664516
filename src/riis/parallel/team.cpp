// SPDX-License-Identifier: Apache-2.0
#include "parallel/team.hpp"

#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <new>
#include <utility>

#include "parallel/parallel_for.hpp"
#include "parallel/semaphore.hpp"

namespace riis {
namespace {

// A waiting thread first stays awake, because waking a sleeping thread takes some microseconds. A waiting worker goes through
// three stages. First it keeps its processor, even if a spinning thread of the caller wants it, so that the worker can begin at
// once. Then the worker offers the processor to other threads, and finally it sleeps. Under the thread sanitizer a thread sleeps
// at once, because waiting awake would fill up the sanitizer's history of accesses.
using std::chrono::microseconds;
#if defined(RIIS_STD_THREADS)
constexpr microseconds longest_awake{0}, longest_alone{0};
#else
constexpr microseconds longest_awake{200}, longest_alone{50};
#endif

void pause_briefly() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

// Waits without sleeping, at most for longest_awake, until the condition holds. Returns whether the condition holds.
template <class Condition>
bool wait_awake(const Condition &holds) {
  const auto start = std::chrono::steady_clock::now();
  for (;;) {
    for (int i = 0; i < 16; ++i) {
      if (holds()) return true;
      pause_briefly();
    }
    const auto waited = std::chrono::steady_clock::now() - start;
    if (waited > longest_awake) return false;
    if (waited > longest_alone) sched_yield();
  }
}

// The state of a team's loop, in one word. The word holds the loop's number, how many workers are inside the loop, and how many
// more may enter. With one atomic operation, a worker can thus enter the loop only if there is still a place.
struct State {
  static constexpr std::uint64_t one_inside = 1, one_place = std::uint64_t{1} << 16, one_loop = std::uint64_t{1} << 32;
  static constexpr std::uint64_t all_places = one_loop - one_place;
  std::uint64_t word;

  int n_inside() const { return static_cast<int>(word & 0xffff); }
  int n_places() const { return static_cast<int>(word >> 16 & 0xffff); }
  std::uint32_t loop() const { return static_cast<std::uint32_t>(word >> 32); }
  bool has_place_after(std::uint32_t last_loop) const { return loop() != last_loop && n_places() > 0; }
};

// A calling thread with its workers. A team serves one loop at a time. Teams and their workers exist until the process ends.
class Team {
 public:
  // Starts workers until the team has n_workers workers. Returns the number of workers, which is less if the system refuses a
  // thread. A team without semaphores has no workers.
  int grow_to(int n_workers) {
    if (!may_start_.is_made() || !may_end_.is_made()) return 0;
    if (n_workers_ < n_workers) {
      n_processors_ = default_thread_count();
      // The caller's signal handlers must run on the caller's threads. Workers therefore block all signals except those of
      // errors.
      sigset_t blocked, before;
      sigfillset(&blocked);
      for (const int error : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGABRT, SIGSYS}) sigdelset(&blocked, error);
      pthread_attr_t detached;
      if (pthread_attr_init(&detached) != 0) return n_workers_;
      pthread_attr_setdetachstate(&detached, PTHREAD_CREATE_DETACHED);
      pthread_sigmask(SIG_SETMASK, &blocked, &before);
      pthread_t thread;
      while (n_workers_ < n_workers && pthread_create(&thread, &detached, serve, this) == 0) ++n_workers_;
      pthread_sigmask(SIG_SETMASK, &before, nullptr);
      pthread_attr_destroy(&detached);
    }
    return std::min(n_workers_, n_workers);
  }

  void run(int n_places, int n_busy_threads, void (*work)(void *, int), void *context) {
    work_ = work, context_ = context;
    waits_awake_.store(n_busy_threads <= n_processors_, std::memory_order_relaxed);
    const State closed{state_.load(std::memory_order_relaxed)};
    const auto n = static_cast<std::uint64_t>(n_places);
    state_.store(closed.word + State::one_loop + n * State::one_place);
    // Workers that are awake notice the new loop by themselves. If the loop has places for more workers, sleeping workers are
    // woken.
    const int n_awake = n_workers_ - n_asleep_.load();
    for (int n_to_wake = take_asleep(n_places - n_awake); n_to_wake > 0; --n_to_wake) may_start_.post();
    work(context, 0);
    if (State{state_.fetch_and(~State::all_places)}.n_inside() > 0) wait_for_workers();
  }

  Team *next = nullptr;  // the next idle team

 private:
  static void *serve(void *team) {
    static_cast<Team *>(team)->work_for_ever();
    return nullptr;
  }

  [[noreturn]] void work_for_ever() {
    // Another loop may have begun before this thread started. `last_loop` is 0 at first, because no loop has the number 0.
    for (std::uint32_t last_loop = 0;;) {
      State state{state_.load()};
      if (!state.has_place_after(last_loop)) {
        wait_for_place(last_loop);
        continue;
      }
      if (!state_.compare_exchange_strong(state.word, state.word - State::one_place + State::one_inside)) continue;
      last_loop = state.loop();
      work_(context_, state.n_places());
      const State left{state_.fetch_sub(State::one_inside)};
      if (left.n_inside() == 1 && caller_sleeps_.exchange(false)) may_end_.post();
    }
  }

  // Subtracts up to n from the number of sleeping workers, and returns how many it subtracted.
  int take_asleep(int n) {
    int n_asleep = n_asleep_.load(), n_taken = 0;
    do n_taken = std::clamp(n, 0, n_asleep);
    while (n_taken > 0 && !n_asleep_.compare_exchange_weak(n_asleep, n_asleep - n_taken));
    return n_taken;
  }

  void wait_for_place(std::uint32_t last_loop) {
    const auto has_place = [&] { return State{state_.load()}.has_place_after(last_loop); };
    if (waits_awake_.load(std::memory_order_relaxed) && wait_awake(has_place)) return;
    // If a loop began just before this worker was counted as sleeping, nobody wakes the worker. The worker therefore checks once
    // more. If take_asleep fails here, the calling thread has already counted this worker, and posts for it.
    n_asleep_.fetch_add(1);
    if (has_place() && take_asleep(1) == 1) return;
    may_start_.wait();
  }

  void wait_for_workers() {
    const auto is_empty = [&] { return State{state_.load()}.n_inside() == 0; };
    if (waits_awake_.load(std::memory_order_relaxed) && wait_awake(is_empty)) return;
    // A post may come late, from a worker of an earlier loop. The calling thread therefore checks after each post whether the
    // present loop has ended.
    while (!is_empty()) {
      caller_sleeps_.store(true);
      if (is_empty() && caller_sleeps_.exchange(false)) return;
      may_end_.wait();
    }
  }

  std::atomic<std::uint64_t> state_{0};
  void (*work_)(void *, int) = nullptr;
  void *context_ = nullptr;
  std::atomic<bool> waits_awake_{false}, caller_sleeps_{false};
  std::atomic<int> n_asleep_{0};  // the workers that sleep and that no post will wake
  // Threads sleep on semaphores, because a condition variable would need a mutex. If the system interrupted a thread that holds
  // the mutex, the calling thread would have to wait for that thread.
  Semaphore may_start_, may_end_;
  int n_workers_ = 0, n_processors_ = 1;
};

// The idle teams. At the end of the process, idle teams are not destroyed, because their workers still wait. There are as many
// teams as the largest number of the caller's threads that were inside loops at the same time. The first few teams are static, so
// a call needs no memory for them.
constexpr std::size_t n_first_teams = 16;
alignas(Team) unsigned char first_teams[n_first_teams][sizeof(Team)];
std::mutex teams_mutex;
std::size_t n_made = 0;
Team *idle_teams = nullptr;
std::atomic<int> n_threads_in_loops{0};

// Returns NULL if there is no memory for a team.
Team *borrow_team() {
  {
    const std::lock_guard<std::mutex> lock(teams_mutex);
    if (Team *const team = idle_teams) {
      idle_teams = team->next;
      return team;
    }
    if (n_made < n_first_teams) return new (first_teams[n_made++]) Team;
  }
  return new (std::nothrow) Team;
}

void give_back(Team *team) noexcept {
  const std::lock_guard<std::mutex> lock(teams_mutex);
  team->next = std::exchange(idle_teams, team);
}

}  // namespace

LoopChoice loop_choice;

int processors_of_machine() noexcept {
  static const int n = static_cast<int>(sysconf(_SC_NPROCESSORS_CONF));
  return n < 1 ? std::numeric_limits<int>::max() : n;  // used if the system does not state the number of processors
}

int run_by_team(int n_threads, void (*work)(void *context, int thread), void *context) {
  Team *const team = borrow_team();
  if (!team) {  // for lack of memory, which must not make a loop fail
    work(context, 0);
    return 1;
  }
  const int n_workers = team->grow_to(n_threads - 1);
  const int n_busy = n_threads_in_loops.fetch_add(1 + n_workers, std::memory_order_relaxed) + 1 + n_workers;
  team->run(n_workers, n_busy, work, context);
  n_threads_in_loops.fetch_sub(1 + n_workers, std::memory_order_relaxed);
  give_back(team);
  return 1 + n_workers;
}

}  // namespace riis
