// SPDX-License-Identifier: Apache-2.0
#include "program/patient/patient_steps.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <system_error>

#include "program/base/other_program.hpp"
#include "program/base/refusal.hpp"
#include "program/base/system.hpp"
#include "program/base/text.hpp"

namespace riis::program {
namespace {

namespace fs = std::filesystem;

const char *const marker_file = "UNFINISHED.txt", *const report_file = "patient.json";

// The names of the files that riis patient writes into its folder. When riis patient uses a folder again, it keeps all other
// files.
const char *const own_names[] = {report_file,     "wall.stl",       "placed.json",        "params.json",
                                 "valve.dat",     "gmsh",           "mesh.msh",           "mesh.vtu",
                                 "faces",         "closed.vtu",     "open.vtu",           "closed.png",
                                 "open.png",      "beat.csv",       "beat.pvd",           "beat",
                                 "leaflets.pvd",  "leaflets",       "beat.mp4",           "logs",
                                 "openfoam",      "fenicsx",        "svmultiphysics",     "landmarks.json",
                                 "landmarks.csv", "beat_table.csv", "landmarks.mrk.json", "landmarks.fcsv",
                                 commands_file};

[[noreturn]] void refuse_folder(const std::string &path, const std::string &reason) {
  refuse_data("--output: " + path + ": " + reason);
}

// Refuses inputs that would be removed when the folder is used again.
void check_inputs(const fs::path &folder, const std::string &path, const std::vector<std::string> &inputs) {
  for (const std::string &input : inputs)
    for (const char *const name : own_names) {
      std::error_code error;
      if (fs::equivalent(folder / name, input, error))
        refuse_folder(path, "its " + std::string(name) + " is also an input, and would be removed: copy it elsewhere");
    }
}

// Returns words about the results that a solver has computed in the folder. Returns "" without results, as in a new case.
std::string computed_in(const fs::path &folder) {
  std::error_code error;
  double last = 0;
  for (const char *const name : {"openfoam", "openfoam/processor0"})
    for (fs::directory_iterator entry(folder / name, error), end; !error && entry != end; entry.increment(error))
      last = std::max(last, number_in(entry->path().filename().string()).value_or(0));
  if (last > 0) return "a computed beat of " + shortest(last) + " s in openfoam";
  for (const char *const name : {"svmultiphysics", "fenicsx"})
    for (fs::directory_iterator entry(folder / name, error), end; !error && entry != end; entry.increment(error)) {
      const std::string file = entry->path().filename().string();
      if (file.find("-procs") != std::string::npos || file.rfind("flow_", 0) == 0)
        return "the computed " + std::string(name) + "/" + file;
    }
  return "";
}

// The locks of the solvers' runs in the folder. A run holds the lock as long as one of its processes lives.
class RunLocks {
 public:
  RunLocks(const fs::path &folder, const std::string &path) {
    for (const char *const solver : {"openfoam", "svmultiphysics", "fenicsx"}) {
      const std::string lock = (folder / solver / ".lock").string();
      const int file = open(lock.c_str(), O_RDONLY | O_CLOEXEC);
      if (file < 0) continue;
      files_.push_back(file);
      if (flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) continue;
      const std::string owner = trimmed(text_of_file(lock));
      release();
      refuse_folder(path, "a run in its folder " + std::string(solver) + " has not ended" +
                              (owner.empty() ? "" : " (process " + owner + ")") +
                              ", and nothing is removed: wait for its end, end it, or name another folder");
    }
  }
  ~RunLocks() { release(); }
  RunLocks(const RunLocks &) = delete;
  RunLocks &operator=(const RunLocks &) = delete;

 private:
  void release() {
    for (const int file : files_) close(file);
    files_.clear();
  }

  std::vector<int> files_;
};

// Removes what an earlier run wrote. All checks are done before the removal. The report is removed first, so that a folder that
// has lost some of its files never looks finished.
void remove_own_files(const fs::path &folder, const std::string &path) {
  const RunLocks locks(folder, path);
  for (const char *const name : own_names) {
    std::error_code error;
    fs::remove_all(folder / name, error);
    if (error) refuse_folder(path, "its " + std::string(name) + " cannot be removed: " + error.message());
  }
}

// Checks the folder if it exists, and makes it otherwise.
std::string taken_folder(const std::string &path, bool replace, const std::vector<std::string> &inputs,
                         std::string &removed) {
  std::error_code error;
  const fs::path folder = fs::absolute(path).lexically_normal();
  if (fs::exists(folder, error)) {
    if (!fs::is_directory(folder, error)) refuse_folder(path, "is a file, not a folder");
    const bool is_unfinished = fs::exists(folder / marker_file, error),
               is_own = is_unfinished || fs::exists(folder / report_file, error);
    const bool is_empty = fs::is_empty(folder, error);
    if (error) refuse_folder(path, "cannot be read: " + error.message());
    if (!is_empty && !is_own)
      refuse_folder(path, "the folder is not empty, and riis patient did not make it: name another folder");
    removed = computed_in(folder);
    if (!is_empty && !is_unfinished && !replace)
      refuse_folder(path, "the folder has the results of an earlier run: name another folder, or write --replace" +
                              (removed.empty() ? "" : ", which also removes " + removed));
    check_inputs(folder, path, inputs);
  } else {
    fs::create_directories(folder, error);
    if (error) refuse_folder(path, "cannot be made: " + error.message());
  }
  return folder.string();
}

}  // namespace

PatientFolder::PatientFolder(const std::string &path, bool replace, const std::vector<std::string> &inputs)
    : path_(taken_folder(path, replace, inputs, removed_)), locks_({(fs::path(path_) / marker_file).string()}) {
  say_if_ended("\nriis: stopped before the folder was finished: run the same command again\n");
  remove_own_files(path_, path);
  std::error_code error;
  fs::current_path(path_, error);
  if (error) refuse_folder(path, "cannot be entered: " + error.message());
  write_text(
      marker_file,
      "riis patient has not finished this folder. If riis patient is no longer running, run the same command again.\n");
  fs::create_directory("logs", error);
  if (error) refuse_folder(path, "cannot be written to: " + error.message());
}

void PatientFolder::finish() {
  std::error_code error;
  fs::remove(marker_file, error);
  if (error) refuse_data(std::string(marker_file) + ": cannot be removed: " + error.message());
  say_if_ended(nullptr);
}

std::string cure_of_full_disc(const std::string &reason) {
  const auto says = [&](int error) { return reason.find(system_text(error)) != std::string::npos; };
  // On a disc that is nearly full, gmsh may leave out a part of a file without saying why.
  constexpr std::uintmax_t hardly_any = 1 << 20;
  std::error_code error;
  const fs::space_info space = fs::space(".", error);
  if (!says(ENOSPC) && !says(EDQUOT) && (error || space.available >= hardly_any)) return "";
  return ". The disc is full: free some space, or name a folder on another disc by --output, and run the command again";
}

PatientSteps::PatientSteps(bool quiet) : program_(path_of_this_program()), quiet_(quiet) {}

void PatientSteps::say(const std::string &label, const std::string &text, double seconds) {
  if (quiet_) return;
  std::string begin = label;
  begin.resize(std::max<std::size_t>(10, begin.size() + 1), ' ');
  write_text("-", begin + text + (seconds < 0 ? "" : " (" + printed("%.1f", seconds) + " s)") + "\n");
}

void PatientSteps::announce(const std::string &command) {
  commands_.push_back(command);
  write_commands();
}

void PatientSteps::note(const std::string &comment, const std::string &command) {
  note_ = "# " + comment + ":\n# " + command + "\n";
  write_commands();
}

void PatientSteps::write_commands() const {
  std::string text = "# The commands of riis patient. They run in this folder.\n";
  for (const Json &command : commands_) text += command.get<std::string>() + "\n";
  write_text(commands_file, text + note_);
}

StepEnd PatientSteps::run(const std::string &name, const std::vector<std::string> &words) {
  std::vector<std::string> typed = words;
  typed.insert(typed.begin(), "riis");
  announce(shell_text(typed));
  return run_silently(name, words);
}

StepEnd PatientSteps::run_silently(const std::string &name, const std::vector<std::string> &words) {
  const double begin = seconds();
  std::vector<std::string> all = words;
  all.insert(all.begin(), program_);
  std::string log;
  const ProgramEnd end = run_program(all, nullptr, [&](const std::string &line) { log += line + "\n"; });
  if (end.error != 0) refuse_data(program_ + ": cannot be run: " + system_text(end.error));
  StepEnd made;
  made.status = end.status;
  const std::string own = "riis: ";
  for (const std::string &line : end.messages) {
    log += line + "\n";
    made.messages.push_back(line.rfind(own, 0) == 0 ? line.substr(own.size()) : line);
  }
  write_text("logs/" + name + ".log", log);
  made.seconds = seconds() - begin;
  return made;
}

void PatientSteps::refuse(const std::string &name, const StepEnd &end, const std::string &cure) const {
  const std::string reason =
      end.status < 0         ? "a signal ended the command of logs/" + name + ".log"
      : end.reason().empty() ? "the command of logs/" + name + ".log ended with status " + std::to_string(end.status)
                             : end.reason();
  throw Refusal{end.status == exit_wrong_usage ? exit_wrong_usage : exit_bad_data, reason + cure};
}

}  // namespace riis::program
