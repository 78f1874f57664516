// SPDX-License-Identifier: Apache-2.0
// Measures the time of a call by its shortest run, because other work on the machine only makes runs longer.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>

namespace bench {

// Returns the seconds of the shortest call. Makes at least five calls, which together last at least a second.
inline double shortest(
    const std::function<void()> &call, const std::function<void()> &before = [] {}) {
  using Clock = std::chrono::steady_clock;
  double least = 1e300, sum = 0;
  for (int n = 0; n < 5 || (sum < 1 && n < 1000); ++n) {
    before();
    const Clock::time_point start = Clock::now();
    call();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    least = std::min(least, seconds);
    sum += seconds;
  }
  return least;
}

}  // namespace bench
