// SPDX-License-Identifier: Apache-2.0
#include "parallel/parallel_for.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <mutex>

#include "common/array_view.hpp"
#include "common/float_environment.hpp"

namespace riis {
namespace {

// The blocks of a loop. Each thread begins with its own share of the blocks, and then helps with the other shares. If the
// previous loop used the same data, a thread therefore finds most of its data in its own cache. The blocks of a share are handed
// out in ascending order. If the body throws in a block, no block with a higher number begins, but all blocks with lower numbers
// are completed. After the loop, the exception of the lowest failed block is rethrown, which is the exception that a single
// thread would meet. No block is left out, because the calling thread goes through all shares in ascending order.
class Blocks {
 public:
  Blocks(std::int64_t n_blocks, int n_threads, LoopBody body)
      : n_shares_(std::min<std::int64_t>({n_blocks, n_threads, most_shares})), body_(body), end_(n_blocks) {
    for (std::int64_t i = 0; i < n_shares_; ++i) {
      view(shares_)[i].next.store(n_blocks * i / n_shares_, std::memory_order_relaxed);
      view(shares_)[i].end = n_blocks * (i + 1) / n_shares_;
    }
  }

  // Runs all blocks, or stops before the first block for which has_to_stop() returns true. Returns the number of blocks that ran.
  // Each thread of the loop calls this function once. The calling thread may also call it before the other threads begin.
  template <class HasToStop>
  std::int64_t run(int thread, const HasToStop &has_to_stop) {
    const FloatEnvironment environment;
    std::int64_t block = 0, n_ran = 0;
    try {
      for (std::int64_t i = 0; i < n_shares_; ++i) {
        Share &share = view(shares_)[(thread + i) % n_shares_];
        while (share.next.load(std::memory_order_relaxed) < share.end) {
          if (has_to_stop()) return n_ran;
          block = share.next.fetch_add(1, std::memory_order_relaxed);
          if (block >= share.end || block >= end_.load(std::memory_order_relaxed)) break;
          body_(block, thread);
          ++n_ran;
        }
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (block < end_.load(std::memory_order_relaxed)) {
        end_.store(block, std::memory_order_relaxed);
        exception_ = std::current_exception();
      }
    }
    return n_ran;
  }
  std::int64_t run(int thread) {
    return run(thread, [] { return false; });
  }
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  static constexpr std::int64_t most_shares = 64;  // further threads also use them; 64 shares take 4 kB of the stack
  struct alignas(64) Share {
    std::atomic<std::int64_t> next;
    std::int64_t end;
  };

  const std::int64_t n_shares_;
  const LoopBody body_;
  std::array<Share, most_shares> shares_;
  std::atomic<std::int64_t> end_;  // the lowest block that has failed, or the number of blocks
  std::mutex mutex_;
  std::exception_ptr exception_;
};

// Runs body(block, thread) on the calling thread, once for every block in [0, n_blocks).
int run_alone(std::int64_t n_blocks, LoopBody body) {
  for (std::int64_t block = 0; block < n_blocks; ++block) body(block, 0);
  return 1;
}

}  // namespace

int default_thread_count() noexcept {
  const int n = omp_get_num_procs();
  return n < 1 ? 1 : n;
}

std::int64_t nanoseconds() noexcept {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

// A loop on one thread does not use OpenMP, because OpenMP's run-time ends the process if memory is lacking. If there are fewer
// blocks than threads, some threads stay idle. A loop on fewer threads would delay the next loop, because GCC's run-time ends the
// threads that a loop leaves out, and later has to start new ones.
int openmp_for(std::int64_t n_blocks, int n_threads, LoopBody body, TimesOfCaller *of_caller) {
  if (n_blocks <= 1 || n_threads == 1 || !begin_threads()) return run_alone(n_blocks, body);
  Blocks blocks(n_blocks, n_threads, body);
  int n_ran = 1;
#pragma omp parallel num_threads(n_threads) default(none) shared(blocks, n_ran, of_caller)
  {
    const int thread = omp_get_thread_num();
    if (thread == 0) {
      n_ran = omp_get_num_threads();
      if (of_caller) of_caller->begins = nanoseconds();
    }
    blocks.run(thread);
    if (thread == 0 && of_caller) of_caller->has_worked = nanoseconds();
  }
  blocks.rethrow();
  return n_ran;
}

int team_for(std::int64_t n_blocks, int n_threads, LoopBody body, LoopChoice &choice) {
  if (n_blocks <= 1 || n_threads == 1 || !begin_threads()) return run_alone(n_blocks, body);
  struct Loop {
    Blocks blocks;
    std::int64_t n_of_caller;  // the number of blocks that the calling thread ran in the team
    std::int64_t has_worked;   // the time at which the thread had run its blocks
  } loop{{n_blocks, n_threads, body}, 0, 0};
  std::int64_t n_alone = 0, begin = nanoseconds();
  if (const std::int64_t time_alone = choice.time_alone(begin); time_alone > 0) {
    const std::int64_t until = begin + time_alone;
    n_alone = loop.blocks.run(0, [&begin, until] { return (begin = nanoseconds()) >= until; });
    loop.blocks.rethrow();
    if (n_alone == n_blocks) return n_threads;
  }
  const auto work = [](void *context, int thread) {
    Loop &of_team = *static_cast<Loop *>(context);
    const std::int64_t n = of_team.blocks.run(thread);
    if (thread == 0) of_team.n_of_caller = n, of_team.has_worked = nanoseconds();
  };
  const int n_ran = run_by_team(n_threads, work, &loop);
  loop.blocks.rethrow();
  const std::int64_t end = nanoseconds(), n_of_others = n_blocks - n_alone - loop.n_of_caller;
  const double per_block =
      static_cast<double>(loop.has_worked - begin) / static_cast<double>(std::max<std::int64_t>(loop.n_of_caller, 1));
  choice.record_team(end - loop.has_worked - static_cast<std::int64_t>(static_cast<double>(n_of_others) * per_block),
                     end);
  return n_ran;
}

int parallel_for(std::int64_t n_blocks, int n_threads, LoopBody body) {
  if (n_blocks <= 1 || n_threads == 1) return run_alone(n_blocks, body);
  if (omp_in_parallel() || omp_get_proc_bind() != omp_proc_bind_false) return openmp_for(n_blocks, n_threads, body);
#if defined(RIIS_STD_THREADS)
  // Under the thread sanitizer, teams run all loops of a time step, so that the sanitizer examines the teams.
  return team_for(n_blocks, n_threads, body, loop_choice);
#else
  const std::int64_t begin = nanoseconds();
  // If there are more threads than processors, some thread has to wait for a processor in every loop of OpenMP. All other threads
  // then wait for it.
  if (n_threads > processors_of_machine() || loop_choice.takes_team(begin))
    return team_for(n_blocks, n_threads, body, loop_choice);
  TimesOfCaller of_caller{begin, begin};
  const int n_ran = openmp_for(n_blocks, n_threads, body, &of_caller);
  const std::int64_t end = nanoseconds();
  // At the beginning of a loop, GCC's run-time also waits until all threads have left the previous loop. In a process's first
  // loop the run-time starts the threads, which does not count as waiting.
  const std::int64_t waited = loop_choice.has_recorded() ? of_caller.begins - begin : 0;
  loop_choice.record(waited + (end - of_caller.has_worked), end);
  return n_ran;
#endif
}

}  // namespace riis
