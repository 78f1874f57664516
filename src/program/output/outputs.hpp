// SPDX-License-Identifier: Apache-2.0
// The program's outputs. Before any long work, the program checks that the outputs can be written. A text is written completely,
// or not at all.
#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "program/base/options.hpp"

namespace riis::program {

// Stores the names of a file of this process and of the folder that contains it. A signal that ends the process then also removes
// this file and this folder. An empty name stands for no file or no folder.
void remove_if_ended(const std::string &folder, const std::string &file);

// Stores a text, which must live as long as the process. A signal that ends the process while this process holds locks then
// prints this text on stderr. nullptr stands for no text.
void say_if_ended(const char *text);

// A temporary folder. The destructor removes the folder with its content.
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

// For each output NAME there is an empty file .riis-NAME.lock beside the output, which this process locks by flock. When the
// process ends for any reason, the kernel releases the lock. The destructor removes the lock file. The handlers of SIGINT,
// SIGTERM and SIGHUP also remove the lock file. A killed run leaves its lock file behind, and the next run uses the lock file
// again.
class OutputLocks {
 public:
  // Throws a Refusal if another run has locked one of the outputs. The paths must not be devices or pipes.
  explicit OutputLocks(const std::vector<std::string> &paths);
  ~OutputLocks();
  OutputLocks(OutputLocks &&other) noexcept = default;
  OutputLocks(const OutputLocks &) = delete;
  OutputLocks &operator=(const OutputLocks &) = delete;

 private:
  void release();

  std::vector<int> files_;  // empty after this object was moved from
};

// Delays Ctrl-C and similar signals while a file is written. Every file is first written under a temporary name, and then gets
// its final name. If the process ended before the file has its final name, the unfinished file would stay behind.

// While an object of this type lives, the first signal SIGINT, SIGTERM or SIGHUP has to wait. When the object is destroyed, the
// waiting signal ends the process. A second signal ends the process at once. A signal that was ignored before stays ignored. If
// another object of this type is alive, a new object does nothing. Threads other than the first may make objects only while
// another object is alive.
class UnbrokenWrite {
 public:
  UnbrokenWrite();
  ~UnbrokenWrite();
  UnbrokenWrite(const UnbrokenWrite &) = delete;
  UnbrokenWrite &operator=(const UnbrokenWrite &) = delete;

  // The signals that end the process.
  static constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};
  // Returns whether a signal is waiting. A caller whose work has several parts should then stop after the present part.
  static bool has_signal();

 private:
  struct sigaction before_[3];
};

// Throws a Refusal for an output that would replace an input or another output. Also refuses a wrong ending, and a folder that is
// not writable. Also throws a Refusal if there is no display for a picture, and if another run is writing the output. The caller
// must keep the returned locks until all outputs are written. more_inputs are other files that the run has read.
[[nodiscard]] OutputLocks check_outputs(const MarkOptions &options, const std::vector<std::string> &more_inputs = {});
[[nodiscard]] OutputLocks check_outputs(const SizeFieldOptions &options, const std::vector<std::string> &more_inputs);
[[nodiscard]] OutputLocks check_outputs(const StatesOptions &options);
[[nodiscard]] OutputLocks check_outputs(const AreaOptions &options);
[[nodiscard]] OutputLocks check_outputs(const PlaceOptions &options);

// place_of follows links to an existing file, and returns the path of the file. folder_of returns the folder of a path, or "." if
// the path has none.
std::filesystem::path place_of(const std::string &path);
std::filesystem::path folder_of(const std::filesystem::path &place);

// Throws a Refusal if an output is one of the given files. In the message, `what` describes the files.
void check_no_output_is(const std::string &what, const std::vector<std::string> &files, const MarkOptions &options);

// Returns whether an output is a file that can be replaced. On stdout, in a device or in a pipe, a later text cannot replace an
// earlier text.
bool can_be_replaced(const std::string &path);
// The first rank writes the text to a file, or to stdout if the path is "-". Afterwards the file is complete. After a failure,
// the file is unchanged.
void write_text(const std::string &path, const std::string &text);

}  // namespace riis::program
