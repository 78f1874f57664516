// SPDX-License-Identifier: Apache-2.0
#include "program/series_lists.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace riis::program {

SeriesLists::SeriesLists(std::function<void(bool)> write) : write_(std::move(write)), thread_([this] { follow(); }) {}

SeriesLists::~SeriesLists() { stop(); }

void SeriesLists::add(const std::function<void()> &note) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    note();
    has_news_ = true;
  }
  changed_.notify_one();
}

void SeriesLists::end() {
  stop();
  write_(true);
}

// A pause follows each writing, twenty times as long, so that lists take little of the run's time.
void SeriesLists::follow() {
  using Clock = std::chrono::steady_clock;
  constexpr Clock::duration longest_pause = std::chrono::milliseconds(500);
  std::unique_lock<std::mutex> lock(mutex_);
  try {
    for (;;) {
      changed_.wait(lock, [this] { return has_news_ || has_ended_; });
      if (has_ended_) return;
      has_news_ = false;
      const Clock::time_point begin = Clock::now();
      write_(false);
      const Clock::duration pause = std::min(20 * (Clock::now() - begin), longest_pause);
      if (changed_.wait_for(lock, pause, [this] { return has_ended_; })) return;
    }
  } catch (...) {
    failure_ = std::current_exception();
  }
}

void SeriesLists::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    has_ended_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

}  // namespace riis::program
