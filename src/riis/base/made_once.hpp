// SPDX-License-Identifier: Apache-2.0
// A value that is made when it is first needed. Several threads may ask for the value at the same time.
#pragma once

#include <atomic>
#include <mutex>

namespace riis {

template <class T>
class MadeOnce {
 public:
  // Returns the value. Before the value exists, one thread calls make(value), and the others wait. If making the value fails, the
  // next call tries again.
  template <class Make>
  T &get(const Make &make) {
    if (is_made_.load(std::memory_order_acquire)) return value_;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!is_made_.load(std::memory_order_relaxed)) {
      make(value_);
      is_made_.store(true, std::memory_order_release);
    }
    return value_;
  }
  // After this call, the next get() makes the value again, from the old value. No other thread may use the value at the same
  // time.
  T &forget() {
    is_made_.store(false, std::memory_order_relaxed);
    return value_;
  }

 private:
  T value_{};
  std::mutex mutex_;
  std::atomic<bool> is_made_{false};
};

}  // namespace riis
