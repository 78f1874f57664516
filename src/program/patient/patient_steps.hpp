// SPDX-License-Identifier: Apache-2.0
// The input is the folder of riis patient. The results are the steps that fill the folder. Each step is a command of riis that
// the user could also type in the folder.
#pragma once

#include <string>
#include <vector>

#include "program/base/options.hpp"
#include "program/base/progress.hpp"
#include "program/input/json.hpp"
#include "program/output/outputs.hpp"

namespace riis::program {

// The folder of one run, which becomes the working folder of the process. A folder that is not finished contains the file
// UNFINISHED.txt. A run uses an existing folder only if it is empty, unfinished, or the folder of an earlier run.
class PatientFolder {
 public:
  // Makes the folder, or uses an empty or unfinished folder. With `replace`, the folder of an earlier run is also allowed.
  // `inputs` are the absolute paths of the files that the run reads.
  PatientFolder(const std::string &path, bool replace, const std::vector<std::string> &inputs);
  // Returns words about the computed results of a solver that were removed, or "".
  const std::string &removed() const { return removed_; }
  // Records that the folder has all its files.
  void finish();

 private:
  std::string removed_;
  std::string path_;  // absolute
  OutputLocks locks_;
};

// If the disc of the working folder is full, returns advice, because a step may have failed for this reason. Otherwise returns
// "".
std::string cure_of_full_disc(const std::string &reason);

// The result of a command.
struct StepEnd {
  int status = 0;
  std::vector<std::string> messages;  // lines of stderr, without the program's name
  double seconds = 0;

  bool is_fine() const { return status == exit_fine; }
  // Returns the last message, which gives the reason if the command failed.
  std::string reason() const { return messages.empty() ? "" : messages.back(); }
};

// The file with the commands of a run. A user can run these commands again in the folder.
inline constexpr const char *commands_file = "commands.sh";

// Runs commands of riis in the working folder, and writes each command to `commands_file`. The output of the commands goes to the
// folder `logs`.
class PatientSteps {
 public:
  explicit PatientSteps(bool quiet);

  // Prints a line with a label and a result. If `seconds` is given, the line ends with the time.
  void say(const std::string &label, const std::string &text, double seconds = -1);
  // Writes a command to the file of commands before it runs.
  void announce(const std::string &command);
  // Appends a command to the file of commands, below a comment. The command does not run.
  void note(const std::string &comment, const std::string &command);
  // Runs riis with the words. `name` is the name of the log.
  StepEnd run(const std::string &name, const std::vector<std::string> &words);
  // Runs the command without writing it to the file of commands.
  StepEnd run_silently(const std::string &name, const std::vector<std::string> &words);
  // Throws a Refusal with the message of a command that failed, followed by `cure`.
  [[noreturn]] void refuse(const std::string &name, const StepEnd &end, const std::string &cure = "") const;
  // Returns the seconds since the start.
  double seconds() const { return whole_.seconds(); }
  const Json &commands() const { return commands_; }

 private:
  void write_commands() const;

  std::string program_, note_;
  bool quiet_;
  const Stage whole_{"", true};
  Json commands_ = Json::array();
};

}  // namespace riis::program
