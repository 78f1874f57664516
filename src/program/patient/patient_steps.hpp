// SPDX-License-Identifier: Apache-2.0
// In: the folder of riis patient. Out: the steps that fill the folder. A step is a command of riis that the user could also type
// there.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "program/base/options.hpp"
#include "program/input/json.hpp"
#include "program/output/outputs.hpp"

namespace riis::program {

// The folder of one run, which becomes the present folder of the process. An unfinished folder has the file UNFINISHED.txt. Only
// such a folder, or the folder of an earlier run, is taken over.
class PatientFolder {
 public:
  // Makes the folder, or takes an empty or an unfinished one, and with `replace` that of an earlier run. `inputs` are absolute
  // paths of files that the run reads.
  PatientFolder(const std::string &path, bool replace, const std::vector<std::string> &inputs);
  // Tells that the folder has all its files.
  void finish();

 private:
  std::string path_;  // absolute
  OutputLocks locks_;
};

// Returns the cure if the disc of the present folder is full, which may be why a step fails, or "".
std::string cure_of_full_disc(const std::string &reason);

// The result of a command.
struct StepEnd {
  int status = 0;
  std::vector<std::string> messages;  // lines of stderr, without the program's name
  double seconds = 0;

  bool is_fine() const { return status == exit_fine; }
  // The last message, which gives the reason if the command failed.
  std::string reason() const { return messages.empty() ? "" : messages.back(); }
};

// Runs commands of riis in the present folder, prints the commands, and keeps their output in the folder `logs`.
class PatientSteps {
 public:
  explicit PatientSteps(bool quiet);

  // Prints a line: a label and a result. With `seconds` the line ends with the time.
  void say(const std::string &label, const std::string &text, double seconds = -1);
  // Prints a command that is about to run.
  void announce(const std::string &command);
  // Runs riis with the words. The name is that of the log.
  StepEnd run(const std::string &name, const std::vector<std::string> &words);
  // Runs the command without printing it.
  StepEnd run_silently(const std::string &name, const std::vector<std::string> &words);
  // Refuses with the message of a command that failed, and a cure or "".
  [[noreturn]] void refuse(const std::string &name, const StepEnd &end, const std::string &cure = "") const;
  // Returns the seconds since the start.
  double seconds() const;
  const Json &commands() const { return commands_; }

 private:
  std::string program_;
  bool quiet_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  Json commands_ = Json::array();
};

}  // namespace riis::program
