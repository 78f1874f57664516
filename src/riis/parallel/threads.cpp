// SPDX-License-Identifier: Apache-2.0
#include "parallel/threads.hpp"

#include <pthread.h>

#include <atomic>

#include "parallel/stay_loaded.hpp"

namespace riis {
namespace {

std::atomic<bool> are_used{false}, are_lost{false};

void begin_child() {
  if (are_used) are_lost = true;
}

}  // namespace

bool begin_threads() noexcept {
  if (!are_used.load(std::memory_order_relaxed)) {
    // Without memory for the handler, the library could not notice a fork, so it starts no threads in that case.
    static const bool is_watched = pthread_atfork(nullptr, nullptr, begin_child) == 0;
    if (!is_watched) return false;
    stay_loaded(&are_used);
    are_used = true;
  }
  return !has_lost_threads();
}

bool has_lost_threads() noexcept { return are_lost.load(std::memory_order_relaxed); }

}  // namespace riis
