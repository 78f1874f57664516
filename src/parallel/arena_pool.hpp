// SPDX-License-Identifier: Apache-2.0
// The arenas that walks run in. An arena is kept after its walk, for the next one: TBB frees an arena only after the workers
// that it called have come and have found nothing to do. On a busy machine they do not come to a short walk, and an arena for
// each walk grew the process by some kilobytes a walk, for ever (TBB 2021.8).
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

// An arena of n_threads threads that nobody else has until it is given back: one from the pool, or a new one where the pool has
// none of that number. So there are never more arenas of a number than there were walks of that number at the same time.
PooledArena *borrow_arena(int n_threads);
void give_back(PooledArena *arena) noexcept;

// How many there are, lent or not.
std::size_t n_arenas() noexcept;

}  // namespace riis
