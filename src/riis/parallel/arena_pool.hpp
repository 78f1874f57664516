// SPDX-License-Identifier: Apache-2.0
// The arenas that walks and builds of scenes run in. An arena is kept for the next of them. TBB frees an arena only after the
// workers that it called have come and have found nothing to do. On a busy machine the workers do not come to a short walk. With
// a new arena for each walk, the process grew by some kilobytes a walk without end (TBB 2021.8).
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>

namespace riis {

struct PooledArena {
  explicit PooledArena(int n_slots) : n_threads(n_slots), arena(n_slots, 1) { arena.initialize(); }

  const int n_threads;  // at most, the calling one among them
  tbb::task_arena arena;
  PooledArena *next = nullptr;  // in the pool
};

// Lends an arena of n_threads threads until it is given back. The arena comes from the pool, or is new if the pool has none of
// that number. So there are never more arenas of a number than were borrowed at the same time.
PooledArena *borrow_arena(int n_threads);
void give_back(PooledArena *arena) noexcept;

// Returns the number of arenas, lent or not.
std::size_t n_arenas() noexcept;

}  // namespace riis
