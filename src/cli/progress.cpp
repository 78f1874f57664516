// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.hpp"

#include <unistd.h>

#include <iostream>

namespace riis::cli {

Stage::Stage(const std::string &what, bool quiet) : begin_(std::chrono::steady_clock::now()) {
  if (quiet || !isatty(STDERR_FILENO)) return;
  watcher_ = std::thread([this, what] {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!ended_.wait_for(lock, std::chrono::seconds(1), [this] { return has_ended_; })) {
      std::cerr << "riis-mark: " << what << " ..." << std::endl;
    }
  });
}

Stage::~Stage() {
  if (!watcher_.joinable()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    has_ended_ = true;
  }
  ended_.notify_one();
  watcher_.join();
}

double Stage::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

}  // namespace riis::cli
