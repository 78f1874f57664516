// SPDX-License-Identifier: Apache-2.0
// The arenas in which walks run and scenes are built. An arena is kept and used again. The reason is that TBB frees an arena
// only after the workers that it called have come and found nothing to do. On a busy machine the workers come too late for a
// short walk. With a new arena for each walk, the process grew without end by some kilobytes for each walk (TBB 2021.8).
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>

namespace riis {

struct PooledArena {
  explicit PooledArena(int n_slots) : n_threads(n_slots), arena(n_slots, 1) { arena.initialize(); }

  const int n_threads;  // the most threads, including the calling one
  tbb::task_arena arena;
  PooledArena *next = nullptr;  // the next idle arena in the pool
};

// Returns an arena of n_threads threads, which the caller must give back. The arena comes from the pool, or is new if no idle
// arena has this number of threads. So there are never more arenas of one size than were borrowed at the same time.
PooledArena *borrow_arena(int n_threads);
void give_back(PooledArena *arena) noexcept;

// Returns the number of all arenas, idle and borrowed.
std::size_t n_arenas() noexcept;

}  // namespace riis
