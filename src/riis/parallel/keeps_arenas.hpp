// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace riis {

// The pool (arena_pool.hpp) keeps its arenas while an object of this type lives. Each handle that a walk or a scene needs has
// one. The arenas go with the last object: a caller may want to end TBB (tbb::finalize), and TBB refuses that while there are
// arenas.
class KeepsArenas {
 public:
  KeepsArenas() noexcept;
  ~KeepsArenas();
  KeepsArenas(const KeepsArenas &) = delete;
  KeepsArenas &operator=(const KeepsArenas &) = delete;
};

}  // namespace riis
