// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace riis {

// The pool (arena_pool.hpp) keeps its arenas while at least one object of this type exists. Each handle that needs a walk or a
// scene has such an object. The last object's destructor frees the arenas, because a caller may want to end TBB (tbb::finalize),
// and TBB refuses that while there are arenas.
class KeepsArenas {
 public:
  KeepsArenas() noexcept;
  ~KeepsArenas();
  KeepsArenas(const KeepsArenas &) = delete;
  KeepsArenas &operator=(const KeepsArenas &) = delete;
};

}  // namespace riis
