// SPDX-License-Identifier: Apache-2.0
// The program's outputs. Before any long work the program checks that it can write them. Text goes out whole or fails.
#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "program/options.hpp"

namespace riis::program {

// Locks on the program's outputs: of two runs that would replace one file, only the first goes on.

// Holds an empty file .riis-NAME.lock beside each output NAME, locked by flock. The kernel ends the lock with its process,
// however that ends. The file is removed when the object ends, and by SIGINT, SIGTERM and SIGHUP. A run that is killed leaves
// the file behind; the next run takes it over.
class OutputLocks {
 public:
  // Throws a Refusal if another run holds the lock of one of these files. The paths name no devices or pipes.
  explicit OutputLocks(const std::vector<std::string> &paths);
  ~OutputLocks();
  OutputLocks(OutputLocks &&other) noexcept = default;
  OutputLocks(const OutputLocks &) = delete;
  OutputLocks &operator=(const OutputLocks &) = delete;

 private:
  void release();

  std::vector<int> files_;  // empty once moved from
};

// Ctrl-C and its like while a file is written. Every file is written beside its place and then moved. A process that ends in
// between leaves the unfinished file behind.

// While an object of this type lives, the first SIGINT, SIGTERM or SIGHUP waits. It ends the process when the object ends. A
// second signal, from a user who will not wait, acts at once. Signals that were ignored stay ignored. Only the first of
// several objects counts: objects made while it lives do nothing. Other threads make
// objects only while it lives.
class UnbrokenWrite {
 public:
  UnbrokenWrite();
  ~UnbrokenWrite();
  UnbrokenWrite(const UnbrokenWrite &) = delete;
  UnbrokenWrite &operator=(const UnbrokenWrite &) = delete;

  // Whether a signal waits. Work in several parts ends after the part.
  static bool has_signal();

 private:
  static constexpr int signals_[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction before_[3];
};

// Throws a Refusal for an output that would replace an input or another output, that has a wrong ending, or whose folder is
// missing or not writable. Throws one also for a picture without a display, and for an output that another run is writing. The
// caller holds the locks until all is written.
// more_inputs are further files that were read.
[[nodiscard]] OutputLocks check_outputs(const MarkOptions &options, const std::vector<std::string> &more_inputs = {});
[[nodiscard]] OutputLocks check_outputs(const StatesOptions &options);

// Whether the path ends so, in capitals or not.
bool has_ending(const std::string &path, const std::string &ending);
// place_of returns the place of the file itself: links to existing files are followed. folder_of returns its folder, or "." if
// it names none.
std::filesystem::path place_of(const std::string &path);
std::filesystem::path folder_of(const std::filesystem::path &place);

// Throws a Refusal for an output that is one of these files, and says what they are.
void check_no_output_is(const std::string &what, const std::vector<std::string> &files, const MarkOptions &options);

// Whether a later text can take an earlier one's place: not on stdout, in a device or in a pipe.
bool can_be_replaced(const std::string &path);
// "-" is stdout. Afterwards a file is complete or as it was before.
void write_text(const std::string &path, const std::string &text);

}  // namespace riis::program
