// SPDX-License-Identifier: Apache-2.0
// The program's outputs. Before any long work, the program checks that the outputs can be written. A text is written completely
// or not at all.
#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "program/base/options.hpp"

namespace riis::program {

// Names a file of this process and its folder. Signals that end the process remove file and folder. Empty names stand for none.
void remove_if_ended(const std::string &folder, const std::string &file);

// A folder among the temporary files. The destructor removes the folder with its content.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &operator=(const TemporaryFolder &) = delete;

  const std::string &path() const { return path_; }

 private:
  std::string path_;
};

// Locks on the program's outputs. Of two runs that would replace the same file, only the first run continues.

// For each output NAME, holds an empty file .riis-NAME.lock next to it, locked by flock. When the process ends for any reason,
// the kernel releases the lock. The destructor removes the file, and so do the handlers of SIGINT, SIGTERM and SIGHUP. A killed
// run leaves the file behind, and the next run takes it over.
class OutputLocks {
 public:
  // Throws a Refusal if another run holds the lock of one of these files. The paths must not be devices or pipes.
  explicit OutputLocks(const std::vector<std::string> &paths);
  ~OutputLocks();
  OutputLocks(OutputLocks &&other) noexcept = default;
  OutputLocks(const OutputLocks &) = delete;
  OutputLocks &operator=(const OutputLocks &) = delete;

 private:
  void release();

  std::vector<int> files_;  // empty after this object was moved from
};

// Delays Ctrl-C and similar signals while a file is written. Every file is first written under a temporary name and then moved.
// If the process ended in between, the unfinished file would stay behind.

// While an object of this type lives, the first SIGINT, SIGTERM or SIGHUP waits. The waiting signal ends the process when the
// object is destroyed. A second signal acts at once. Signals that were ignored stay ignored. Objects made during another object's
// life do nothing. Other threads may make objects only during the life of one.
class UnbrokenWrite {
 public:
  UnbrokenWrite();
  ~UnbrokenWrite();
  UnbrokenWrite(const UnbrokenWrite &) = delete;
  UnbrokenWrite &operator=(const UnbrokenWrite &) = delete;

  // The signals that end the process.
  static constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};
  // Returns whether a signal waits. After such a signal, callers that work in several parts stop after the present part.
  static bool has_signal();

 private:
  struct sigaction before_[3];
};

// Throws a Refusal for an output that would replace an input or another output, has a wrong ending, or has no writable folder.
// Also throws a Refusal for a picture without a display, and for an output that another run is writing. The caller must
// keep the returned locks until everything is written. more_inputs are other files that were read.
[[nodiscard]] OutputLocks check_outputs(const MarkOptions &options, const std::vector<std::string> &more_inputs = {});
[[nodiscard]] OutputLocks check_outputs(const SizeFieldOptions &options, const std::vector<std::string> &more_inputs);
[[nodiscard]] OutputLocks check_outputs(const StatesOptions &options);
[[nodiscard]] OutputLocks check_outputs(const AreaOptions &options);
[[nodiscard]] OutputLocks check_outputs(const PlaceOptions &options);

// place_of follows links to existing files, and returns the path of the file itself. folder_of returns the folder of a path, or
// "." if the path has no folder.
std::filesystem::path place_of(const std::string &path);
std::filesystem::path folder_of(const std::filesystem::path &place);

// Throws a Refusal for an output that is one of these files. `what` describes the files in the message.
void check_no_output_is(const std::string &what, const std::vector<std::string> &files, const MarkOptions &options);

// Returns whether a later text can replace an earlier one. Replacing is impossible on stdout, in a device and in a pipe.
bool can_be_replaced(const std::string &path);
// Writes a file, or stdout if the path is "-", on the first rank. Afterwards the file is complete or, after a failure, unchanged.
void write_text(const std::string &path, const std::string &text);

}  // namespace riis::program
