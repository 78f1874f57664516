// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace riis {

// The positions i of a list with begin <= i < end.
struct Range {
  std::int64_t begin, end;
};

// The number of threads of a call. The object also records whether the caller or the library chose this number.
class Threads {
 public:
  // A number that the caller requested.
  Threads(int n) : n_(n) {}  // NOLINT(google-explicit-constructor): most callers pass a number
  // The number that the library chooses if the caller requests none: one thread, plus one for each `per_thread` items of work,
  // but at most `most`.
  static Threads by_default(std::int64_t n_items, std::int64_t per_thread, int most) {
    Threads made(static_cast<int>(std::min<std::int64_t>(1 + std::max<std::int64_t>(n_items, 0) / per_thread, most)));
    made.is_default_ = true;
    return made;
  }

  operator int() const { return n_; }  // NOLINT(google-explicit-constructor)

  // Returns the number of threads for a part of the call that has n_items of work. If the library chose the number of threads,
  // the result is 1 for fewer than `few` items.
  int for_part(std::int64_t n_items, std::int64_t few) const { return is_default_ && n_items < few ? 1 : n_; }

 private:
  int n_;
  bool is_default_ = false;
};

// Returns whether this process may use several threads, and records the use. A child of fork() may not use several threads if the
// library did so before the fork. The child lacks the threads of its parent, and the run-times of OpenMP and TBB would wait for
// these threads for ever.
bool begin_threads() noexcept;

// Returns whether this process is a child of fork() that may not use several threads.
bool has_lost_threads() noexcept;

// The pool (arena.hpp) keeps its arenas while at least one object of this type exists. Each handle that walks over a mesh or has
// a scene of Embree owns one such object. The arenas are freed with the last of these objects, because TBB refuses to end
// (tbb::finalize) while there are arenas.
class KeepsArenas {
 public:
  KeepsArenas() noexcept;
  ~KeepsArenas();
  KeepsArenas(const KeepsArenas &) = delete;
  KeepsArenas &operator=(const KeepsArenas &) = delete;
};

}  // namespace riis
