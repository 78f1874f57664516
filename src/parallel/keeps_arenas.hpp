// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace riis {

// The pool of arenas (arena_pool.hpp) keeps them as long as one of these lives: each handle that a walk needs has one. The arenas
// go with the last of them, because a caller may want to end TBB (tbb::finalize), which TBB refuses while there are arenas.
class KeepsArenas {
 public:
  KeepsArenas() noexcept;
  ~KeepsArenas();
  KeepsArenas(const KeepsArenas &) = delete;
  KeepsArenas &operator=(const KeepsArenas &) = delete;
};

}  // namespace riis
