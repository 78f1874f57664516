// SPDX-License-Identifier: Apache-2.0
// The stages of a run. Each is timed, and a stage that takes longer than a second prints a line on the terminal.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

namespace riis::program {

class Stage {
 public:
  // Prints `what`, such as "reading mesh.vtu", on stderr after a second. Prints nothing if `quiet`, or if stderr is not a
  // terminal.
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

// Counts the steps of a long stage in one line on the terminal. The line appears after one second.
class StepProgress {
 public:
  // Prints `what`, such as "writing", before "step 12 of 81". Prints nothing if `quiet`, or if stderr is not a terminal.
  StepProgress(const std::string &what, std::size_t n_steps, bool quiet);
  ~StepProgress();
  StepProgress(const StepProgress &) = delete;
  StepProgress &operator=(const StepProgress &) = delete;

  void begin(std::size_t step);

 private:
  std::string what_;
  std::size_t n_steps_;
  bool is_shown_, has_line_ = false;
  std::chrono::steady_clock::time_point begin_, last_;
};

}  // namespace riis::program
