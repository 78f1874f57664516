// SPDX-License-Identifier: Apache-2.0
// Work in an arena of the pool, and TBB's limit of threads around it. Embree's scenes and walks run in such an arena. So TBB
// lends them the caller's n_threads threads, not all threads of the process.
#pragma once

#if !defined(RIIS_STD_THREADS)

#include <tbb/global_control.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "parallel/arena_pool.hpp"
#include "parallel/threads.hpp"

namespace riis {

// An arena of up to n_threads threads, including the calling one. The pool lends it while this object lives. TBB limits the
// threads of the process. If that limit is lower than n_threads, this object raises it while it lives, unless the caller set
// it. The arena stays within the limit, because TBB would announce a larger one on stderr. An arena of one thread calls no other.
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

// The thread sanitizer does not understand TBB, so the library itself does without it there.
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
