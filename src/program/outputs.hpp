// SPDX-License-Identifier: Apache-2.0
// The program's outputs. Before any long work the program checks that it can write them. Text goes out whole or fails.
#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "program/options.hpp"

namespace riis::program {

// Locks on the program's outputs. If two runs would replace the same file, only the first one goes on.

// Holds an empty file .riis-NAME.lock beside each output NAME, locked by flock. The kernel ends the lock when its process ends
// for any reason. The file is removed when the object ends, and by SIGINT, SIGTERM and SIGHUP. A run that is killed leaves the
// file behind; the next run takes it over.
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

  std::vector<int> files_;  // empty after a move
};

// Handles Ctrl-C and similar signals while a file is written. Every file is written beside its place and then moved. A process
// that ends in between leaves the unfinished file behind.

// While an object of this type lives, the first SIGINT, SIGTERM or SIGHUP waits. It ends the process when the object ends. A
// second signal acts at once. Signals that were ignored stay ignored. Objects that are made while another one lives do nothing.
// Other threads may make objects only while one lives.
class UnbrokenWrite {
 public:
  UnbrokenWrite();
  ~UnbrokenWrite();
  UnbrokenWrite(const UnbrokenWrite &) = delete;
  UnbrokenWrite &operator=(const UnbrokenWrite &) = delete;

  // Tells whether a signal waits. Work in several parts then ends after the present part.
  static bool has_signal();

 private:
  static constexpr int signals_[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction before_[3];
};

// Throws a Refusal for an output that would replace an input or another output, that has a wrong ending, or whose folder is
// missing or not writable. It also throws one for a picture without a display, and for an output that another run is writing.
// The caller holds the locks until all is written. more_inputs are further files that were read.
[[nodiscard]] OutputLocks check_outputs(const MarkOptions &options, const std::vector<std::string> &more_inputs = {});
[[nodiscard]] OutputLocks check_outputs(const StatesOptions &options);

// Tells whether the path has this ending, in small letters or capitals.
bool has_ending(const std::string &path, const std::string &ending);
// place_of follows links to existing files and returns the place of the file itself. folder_of returns its folder, or "." if it
// names none.
std::filesystem::path place_of(const std::string &path);
std::filesystem::path folder_of(const std::filesystem::path &place);

// Throws a Refusal for an output that is one of these files. `what` describes the files in the message.
void check_no_output_is(const std::string &what, const std::vector<std::string> &files, const MarkOptions &options);

// Tells whether a later text can replace an earlier one. It cannot on stdout, in a device or in a pipe.
bool can_be_replaced(const std::string &path);
// Writes a file, or stdout for "-". Afterwards the file is complete or unchanged.
void write_text(const std::string &path, const std::string &text);

}  // namespace riis::program
