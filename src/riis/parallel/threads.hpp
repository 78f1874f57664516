// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace riis {

// The number of threads of a call, and who chose it.
class Threads {
 public:
  // The caller requested this number.
  Threads(int n) : n_(n) {}  // NOLINT(google-explicit-constructor): a number is enough for most
  // The caller requested no number: one thread, and one more for each `per_thread` items of the call's work, at most `most`.
  static Threads by_default(std::int64_t n_items, std::int64_t per_thread, int most) {
    Threads made(static_cast<int>(std::min<std::int64_t>(1 + std::max<std::int64_t>(n_items, 0) / per_thread, most)));
    made.is_default_ = true;
    return made;
  }

  operator int() const { return n_; }  // NOLINT(google-explicit-constructor)

  // Returns the number for a part of the call, with n_items of its own. A default number becomes 1 below `few` items. All
  // other parts take the same number, because GCC's run-time ends the threads that a smaller team leaves out.
  int for_part(std::int64_t n_items, std::int64_t few) const { return is_default_ && n_items < few ? 1 : n_; }

 private:
  int n_;
  bool is_default_ = false;
};

// Returns whether this process may use several threads, and notes that it does. A child of fork() may not if the library had used
// several before the fork: the run-times of OpenMP and TBB would wait for ever for threads that the child lacks.
bool begin_threads() noexcept;

// Returns whether this process is a child that may not use several threads.
bool has_lost_threads() noexcept;

}  // namespace riis
