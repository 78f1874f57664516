// SPDX-License-Identifier: Apache-2.0
// Runs work in an arena of the pool, after TBB's limit on threads was adjusted for this work. Embree's scenes are built in such
// an arena, and concurrent walks also run in one. TBB then uses only n_threads threads, as the caller has requested, and not all
// threads of the process.
#pragma once

#if !defined(RIIS_STD_THREADS)

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "parallel/threads.hpp"

namespace riis {

// An arena is kept and used again. TBB frees an arena only after all the workers that it called have arrived and found no work.
// On a busy machine, a short walk ends long before they arrive. With a new arena for each walk, the process would therefore grow
// by some kilobytes in each walk (TBB 2021.8).
struct PooledArena {
  explicit PooledArena(int n_slots) : n_threads(n_slots), arena(n_slots, 1) { arena.initialize(); }

  const int n_threads;  // the most threads, including the calling one
  tbb::task_arena arena;
  PooledArena *next = nullptr;  // the next idle arena in the pool
};

// Returns an arena of n_threads threads, which the caller must give back. The arena comes from the pool. A new arena is made only
// if no idle arena has this number of threads. There are therefore never more arenas of one size than were borrowed at the same
// time.
PooledArena *borrow_arena(int n_threads);
void give_back(PooledArena *arena) noexcept;

// Returns the number of all arenas, idle and borrowed.
std::size_t n_arenas() noexcept;

// Borrows an arena of up to n_threads threads, including the calling thread, during the life of this object. TBB has a limit on
// the threads of the process. A limit below n_threads is raised while this object lives, unless the caller has set this limit. An
// arena never has more threads than the limit, because TBB would then print a message on stderr. An arena of one thread uses only
// the calling thread.
class Arena {
 public:
  explicit Arena(int n_threads) {
    const auto wanted = static_cast<std::size_t>(n_threads > 1 && !begin_threads() ? 1 : n_threads);
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

}  // namespace riis

#else

namespace riis {

// The thread sanitizer does not understand TBB. Under the sanitizer the library itself does not use TBB.
class Arena {
 public:
  explicit Arena(int) {}

  template <class Work>
  void run(const Work &work) {
    work();
  }
};

}  // namespace riis

#endif
