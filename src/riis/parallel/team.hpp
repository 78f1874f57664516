// SPDX-License-Identifier: Apache-2.0
// Threads for the loops of a time step on a busy machine. Between loops the threads wait, first awake and then asleep. A loop
// does not wait for a thread that another process delays, because the calling thread does the delayed thread's work.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>

namespace riis {

// Calls work(context, 0) on the calling thread. Also calls work(context, thread), 0 < thread < n_threads, on each further thread
// that arrives before the calling thread has finished. Returns after the calls of all threads have returned. Returns the number
// of threads that took part. This number is less than n_threads only if the system refuses a thread, a semaphore or memory.
// `work` must not throw.
int run_by_team(int n_threads, void (*work)(void *context, int thread), void *context);

// Chooses between OpenMP's threads, a team and the calling thread. OpenMP's threads begin a loop sooner than a team does, and
// they also run the caller's own loops. However, a loop of OpenMP waits for all its threads, even if another process occupies one
// of the processors for long. After a long wait, teams therefore run the loops for some time, and then OpenMP runs them again. If
// OpenMP's next long wait comes after only a few loops, the machine is busy. Teams then run the loops for twice as long as
// before. A team also loses time if another process interrupts one of its threads inside a block. The calling thread therefore
// begins a team's loop alone. The time after which it calls the team is the mean time that recent loops lost by calling their
// teams. Suppose that this loop's team loses no more than that mean time. The loop then takes at most twice as long as without
// the team, or as with the team from the beginning. All times are in nanoseconds.
class LoopChoice {
 public:
  static constexpr std::int64_t long_wait = 2'000'000, first_pause = 250'000'000, longest_pause = 2'000'000'000;
  static constexpr int few_loops = 32;                          // about three time steps
  static constexpr double loops_in_mean = 16, half_life = 1e9;  // for the mean loss
  static constexpr double least_loss = 5'000;                   // a smaller mean loss counts as none

  bool takes_team(std::int64_t now) const noexcept { return now < until_.load(std::memory_order_relaxed); }
  bool has_recorded() const noexcept {
    return pause_.load(std::memory_order_relaxed) > 0 || n_served_.load(std::memory_order_relaxed) > 0;
  }
  // Records that a loop of OpenMP ended now. `waited` is the time that the calling thread waited for the other threads, at the
  // beginning and at the end of this loop. On a quiet machine, the calling thread waits for one block at most, which takes less
  // than a millisecond.
  void record(std::int64_t waited, std::int64_t now) noexcept {
    const int n_served = n_served_.load(std::memory_order_relaxed);
    if (waited < long_wait) {
      if (n_served < few_loops) n_served_.store(n_served + 1, std::memory_order_relaxed);
      return;
    }
    const std::int64_t last = pause_.load(std::memory_order_relaxed);
    const std::int64_t pause = n_served < few_loops ? std::clamp(2 * last, first_pause, longest_pause) : first_pause;
    n_served_.store(0, std::memory_order_relaxed);
    pause_.store(pause, std::memory_order_relaxed);
    until_.store(now + pause, std::memory_order_relaxed);
  }

  // Returns how long the calling thread works alone in a loop that begins now. While no new losses are recorded, this time
  // becomes shorter, so that teams are tried again.
  std::int64_t time_alone(std::int64_t now) const noexcept {
    const double mean = mean_loss(now);
    return mean < least_loss ? 0 : static_cast<std::int64_t>(mean);
  }
  // Records a loop that called a team and ended now. `lost` is the time that the calling thread waited at the end, minus the time
  // that it would have needed for the work of the other threads.
  void record_team(std::int64_t lost, std::int64_t now) noexcept {
    const double before = mean_loss(now), more = static_cast<double>(std::max<std::int64_t>(lost, 0)) - before;
    mean_loss_.store(before + more / loops_in_mean, std::memory_order_relaxed);
    recorded_.store(now, std::memory_order_relaxed);
  }

 private:
  double mean_loss(std::int64_t now) const noexcept {
    const double mean = mean_loss_.load(std::memory_order_relaxed);
    if (mean < 1) return 0;
    const double n_halves = static_cast<double>(now - recorded_.load(std::memory_order_relaxed)) / half_life;
    // The recorded loss is halved after each half life. Within a half life it falls linearly.
    const double whole = std::clamp(std::floor(n_halves), 0.0, 64.0), rest = std::clamp(n_halves - whole, 0.0, 1.0);
    return std::ldexp(mean * (1 - 0.5 * rest), -static_cast<int>(whole));
  }

  std::atomic<std::int64_t> until_{0}, pause_{0}, recorded_{0};
  std::atomic<int> n_served_{0};  // the number of OpenMP's loops since the last pause, few_loops at most
  std::atomic<double> mean_loss_{0};
};

// The process's choice between OpenMP and a team. Several threads may record loops at the same time. It is then enough that one
// of their records is kept.
extern LoopChoice loop_choice;

}  // namespace riis
