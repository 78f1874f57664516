// SPDX-License-Identifier: Apache-2.0
#include "program/base/progress.hpp"

#include <unistd.h>

#include <iostream>

namespace riis::program {

namespace {

bool is_terminal() { return isatty(STDERR_FILENO) != 0; }

}  // namespace

std::chrono::milliseconds Silence::now() const { return is_terminal() ? on_terminal : in_log; }

Stage::Stage(const std::string &what, bool quiet, Silence silence) : begin_(std::chrono::steady_clock::now()) {
  if (quiet) return;
  watcher_ = std::thread([this, what, silence] {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!ended_.wait_for(lock, silence.now(), [this] { return has_ended_; })) {
      std::cerr << "riis: " << what << " ..." << std::endl;
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

StepProgress::StepProgress(const std::string &what, std::size_t n_steps, bool quiet, Silence silence)
    : what_(what),
      n_steps_(n_steps),
      is_shown_(!quiet),
      is_terminal_(is_terminal()),
      silence_(silence.now()),
      begin_(std::chrono::steady_clock::now()),
      last_(begin_) {}

StepProgress::~StepProgress() {
  if (has_line_ && is_terminal_) std::cerr << std::endl;
}

void StepProgress::begin(std::size_t step) {
  const auto now = std::chrono::steady_clock::now();
  if (!is_shown_ || now - begin_ < silence_) return;
  const std::chrono::milliseconds between = is_terminal_ ? std::chrono::milliseconds(200) : silence_;
  if (has_line_ && now - last_ < between && (step + 1 < n_steps_ || !is_terminal_)) return;
  last_ = now;
  has_line_ = true;
  const double left = std::chrono::duration<double>(now - begin_).count() / static_cast<double>(step) *
                      static_cast<double>(n_steps_ - step);
  // Blanks at the end of the line overwrite the rest of a longer previous line.
  std::cerr << (is_terminal_ ? "\r" : "") << "riis: " << what_ << ": step " << step + 1 << " of " << n_steps_ << ", "
            << static_cast<long long>(left + 0.5) << " s left" << (is_terminal_ ? "   " : "\n") << std::flush;
}

}  // namespace riis::program
