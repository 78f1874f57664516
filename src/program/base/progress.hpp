// SPDX-License-Identifier: Apache-2.0
// The stages of a run. Each stage is timed. A stage that takes longer than a second prints a line on the terminal. In a log,
// where every line stays, a stage prints its line only after half a minute.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

namespace riis::program {

// The time for which a stage prints nothing. The time is longer in a log than on a terminal.
struct Silence {
  std::chrono::milliseconds on_terminal{1000}, in_log{30000};

  std::chrono::milliseconds now() const;
};

class Stage {
 public:
  // Prints `what`, such as "reading mesh.vtu", on stderr if the stage takes longer than the silence. Prints nothing if `quiet`.
  Stage(const std::string &what, bool quiet, Silence silence = {});
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

// Counts the steps of a long stage. On a terminal, the count is updated in one line. In a log, a new line is added after each
// silence.
class StepProgress {
 public:
  // Prints `what`, such as "writing", before "step 12 of 81". Prints nothing if `quiet`.
  StepProgress(const std::string &what, std::size_t n_steps, bool quiet, Silence silence = {});
  ~StepProgress();
  StepProgress(const StepProgress &) = delete;
  StepProgress &operator=(const StepProgress &) = delete;

  void begin(std::size_t step);

 private:
  std::string what_;
  std::size_t n_steps_;
  bool is_shown_, is_terminal_, has_line_ = false;
  std::chrono::milliseconds silence_;
  std::chrono::steady_clock::time_point begin_, last_;
};

}  // namespace riis::program
