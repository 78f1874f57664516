// SPDX-License-Identifier: Apache-2.0
// Tests progress in a log. After each silence, a long stage prints one whole line. A short or quiet stage prints nothing.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <iostream>
#include <string>
#include <thread>

#include "program/base/progress.hpp"

namespace {

using riis::program::Silence;
using std::chrono::milliseconds;

int n_faults = 0;

void expect(bool is_right, const char *what) {
  if (!is_right) std::printf("not true: %s\n", what);
  n_faults += !is_right;
}

// Returns the text that the function prints on stderr, which is a file during the call.
template <class Function>
std::string printed_by(const Function &function) {
  std::FILE *const file = std::tmpfile();
  const int before = dup(STDERR_FILENO);
  dup2(fileno(file), STDERR_FILENO);
  function();
  std::cerr.flush();
  dup2(before, STDERR_FILENO);
  close(before);
  std::string text(static_cast<std::size_t>(lseek(fileno(file), 0, SEEK_END)), ' ');
  std::rewind(file);
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  return text;
}

std::string steps(int n, milliseconds each, bool quiet, Silence silence) {
  return printed_by([&] {
    riis::program::StepProgress progress("writing", static_cast<std::size_t>(n), quiet, silence);
    for (int i = 0; i < n; ++i) {
      progress.begin(static_cast<std::size_t>(i));
      std::this_thread::sleep_for(each);
    }
  });
}

std::string stage(milliseconds length, bool quiet, Silence silence) {
  return printed_by([&] {
    const riis::program::Stage running("reading mesh.vtu", quiet, silence);
    std::this_thread::sleep_for(length);
  });
}

}  // namespace

int main() {
  const Silence silence{milliseconds(1), milliseconds(100)}, long_silence{milliseconds(1), milliseconds(100000)};
  const std::string text = steps(50, milliseconds(10), false, silence);
  long n_lines = 0;
  for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1, ++n_lines)
    expect(text.compare(begin, 20, "riis: writing: step ") == 0, "each line begins with the stage");
  // The 50 steps take at least half a second. On a busy machine, steps take longer and give more lines.
  expect(n_lines >= 2 && n_lines <= 49, "there are some lines, not one a step");
  expect(!text.empty() && text.back() == '\n' && text.find('\r') == std::string::npos, "the lines are whole");
  expect(steps(5, milliseconds(10), false, long_silence).empty(), "a short stage of steps is silent");
  expect(steps(50, milliseconds(10), true, silence).empty(), "a quiet stage of steps is silent");
  expect(stage(milliseconds(400), false, silence) == "riis: reading mesh.vtu ...\n", "a long stage prints one line");
  expect(stage(milliseconds(10), false, long_silence).empty(), "a short stage is silent");
  expect(stage(milliseconds(400), true, silence).empty(), "a quiet stage is silent");
  return n_faults == 0 ? 0 : 1;
}
