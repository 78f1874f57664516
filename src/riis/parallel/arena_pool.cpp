// SPDX-License-Identifier: Apache-2.0
#include "parallel/arena.hpp"

#if !defined(RIIS_STD_THREADS)

#include <tbb/global_control.h>
#include <unistd.h>

#include <cstdint>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/fork_lock.hpp"
#include "parallel/threads.hpp"

namespace riis {
namespace {

// The pool is not destroyed when the process exits, because destructors of the caller's static objects may still run walks.
struct Pool {
  std::int64_t n_keepers = 0;
  std::size_t n_arenas = 0;
  PooledArena *idle = nullptr;  // a linked list, because giving back must not need memory
  pid_t process = 0;            // the process that made the arenas
};
Pool pool;
static_assert(std::is_trivially_destructible_v<Pool>);
std::mutex pool_mutex;
[[maybe_unused]] const bool pool_is_free_in_children = is_free_in_children<pool_mutex>();

PooledArena *take_idle(int n_threads) noexcept {
  const std::lock_guard<std::mutex> lock(pool_mutex);
  for (PooledArena **place = &pool.idle; *place; place = &(*place)->next) {
    PooledArena *const arena = *place;
    if (arena->n_threads != n_threads) continue;
    *place = arena->next;
    return arena;
  }
  return nullptr;
}

void destroy(PooledArena *first) noexcept {
  std::optional<tbb::global_control> no_workers;
  try {
    // While TBB's limit is one thread, TBB frees an arena at once, without waiting for the workers that it has called.
    no_workers.emplace(tbb::global_control::max_allowed_parallelism, 1);
  } catch (...) {  // there is no memory for the limit, so TBB frees the arena later or keeps it
  }
  while (first) delete std::exchange(first, first->next);
}

}  // namespace

PooledArena *borrow_arena(int n_threads) {
  if (PooledArena *const idle = take_idle(n_threads)) return idle;
  auto *const made = new PooledArena(n_threads);
  const std::lock_guard<std::mutex> lock(pool_mutex);
  ++pool.n_arenas;
  pool.process = getpid();
  return made;
}

void give_back(PooledArena *arena) noexcept {
  const std::lock_guard<std::mutex> lock(pool_mutex);
  arena->next = std::exchange(pool.idle, arena);
}

std::size_t n_arenas() noexcept {
  const std::lock_guard<std::mutex> lock(pool_mutex);
  return pool.n_arenas;
}

KeepsArenas::KeepsArenas() noexcept {
  const std::lock_guard<std::mutex> lock(pool_mutex);
  ++pool.n_keepers;
}

KeepsArenas::~KeepsArenas() {
  PooledArena *first = nullptr;
  {
    const std::lock_guard<std::mutex> lock(pool_mutex);
    --pool.n_keepers;
    // A child of fork() frees no arenas. The child lacks the worker threads, and TBB might wait for locks that these threads
    // held.
    if (pool.n_keepers > 0 || getpid() != pool.process) return;
    first = std::exchange(pool.idle, nullptr);
    for (const PooledArena *arena = first; arena; arena = arena->next) --pool.n_arenas;
  }
  if (first) destroy(first);
}

}  // namespace riis

#else

#include "parallel/threads.hpp"

namespace riis {

// Without TBB there is no pool, so these functions do nothing.
KeepsArenas::KeepsArenas() noexcept = default;
KeepsArenas::~KeepsArenas() = default;

}  // namespace riis

#endif
