// SPDX-License-Identifier: Apache-2.0
// The stages of a run: the time of each, and a line on the terminal for a stage that takes longer than a second.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace riis::cli {

class Stage {
 public:
  // what, such as "reading mesh.vtu", is announced on stderr after a second if stderr is a terminal and not quiet.
  Stage(const std::string &what, bool quiet);
  ~Stage();
  Stage(const Stage &) = delete;
  Stage &operator=(const Stage &) = delete;

  double seconds() const;

 private:
  std::chrono::steady_clock::time_point begin_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::thread watcher_;
};

}  // namespace riis::cli
