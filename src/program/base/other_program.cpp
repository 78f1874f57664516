// SPDX-License-Identifier: Apache-2.0
#include "program/base/other_program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <system_error>

#include "program/base/refusal.hpp"
#include "program/base/system.hpp"
#include "program/base/text.hpp"

extern char **environ;

namespace riis::program {

namespace {

// The file descriptors that a started program gets.
class Files {
 public:
  Files() {
    if (posix_spawn_file_actions_init(&actions_) != 0) throw std::bad_alloc();
  }
  ~Files() { posix_spawn_file_actions_destroy(&actions_); }
  Files(const Files &) = delete;
  Files &operator=(const Files &) = delete;

  void read_nothing() { posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0); }
  void pass(int from, int to) { posix_spawn_file_actions_adddup2(&actions_, from, to); }

  // Starts the program whose name is the first word. Returns 0, or the error if the program could not be started.
  int start(const std::vector<std::string> &words, pid_t &process) const {
    std::vector<char *> arguments;
    for (const std::string &word : words) arguments.push_back(const_cast<char *>(word.c_str()));
    arguments.push_back(nullptr);
    return posix_spawnp(&process, words[0].c_str(), &actions_, nullptr, arguments.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_;
};

// Waits until a program ends. Returns the exit status, or -1 if a signal ended the program.
int status_of(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Calls `read` with each line of a file. Empty lines are left out.
void read_lines(std::FILE *file, const std::function<void(const std::string &)> &read) {
  std::string line;
  for (int c = std::fgetc(file); c != EOF || !line.empty(); c = std::fgetc(file)) {
    if (c != '\n' && c != EOF) {
      line += static_cast<char>(c);
      continue;
    }
    if (!line.empty()) read(line);
    line.clear();
  }
}

}  // namespace

TemporaryFile temporary_file() { return TemporaryFile(std::tmpfile()); }

ProgramEnd run_program(const std::vector<std::string> &words, std::FILE *input,
                       const std::function<void(const std::string &)> &read) {
  ProgramEnd end;
  const TemporaryFile messages = temporary_file();
  int ends[2];
  if (!messages || !make_pipe(ends)) {
    end.error = errno;
    return end;
  }
  const TemporaryFile output(fdopen(ends[0], "r"));
  Files files;
  input ? files.pass(fileno(input), STDIN_FILENO) : files.read_nothing();
  files.pass(ends[1], STDOUT_FILENO);
  files.pass(fileno(messages.get()), STDERR_FILENO);
  pid_t process = 0;
  end.error = files.start(words, process);
  close(ends[1]);
  if (end.error != 0) return end;
  read_lines(output.get(), read);
  end.status = status_of(process);
  std::rewind(messages.get());
  read_lines(messages.get(), [&end](const std::string &line) { end.messages.push_back(line); });
  if (!end.messages.empty()) end.last_message = end.messages.back();
  // According to POSIX, posix_spawnp may succeed although the program cannot be run. The new process then ends with the status
  // not_run.
  constexpr int not_run = 127;
  if (end.status == not_run && end.messages.empty()) end.error = ENOENT;
  return end;
}

std::string program_on_path(const std::string &name) {
  const char *path = std::getenv("PATH");
  for (const std::string &folder : split(path ? path : "", ":")) {
    const std::string program = folder + "/" + name;
    std::error_code error;
    if (!folder.empty() && std::filesystem::is_regular_file(program, error) && access(program.c_str(), X_OK) == 0)
      return program;
  }
  return "";
}

std::string python_of_user() {
  const char *named = std::getenv("RIIS_PYTHON");
  return named != nullptr && named[0] != '\0' ? named : "python3";
}

void run_view(int argc, char **argv) {
  const std::string python = python_of_user();
  const std::string looks_for_package =
      "import importlib.util as u, sys; sys.exit(0 if u.find_spec('riis') and u.find_spec('riis.__main__') else 3)";
  const ProgramEnd end = run_program({python, "-c", looks_for_package});
  if (end.error != 0 || end.status != 0) {
    const char *const fault = end.error != 0    ? " cannot be run"
                              : end.status == 3 ? " does not find the Python package riis"
                                                : " fails when it imports the Python package riis";
    refuse_data("view: " + python + fault +
                "; install it by 'python3 -m venv ~/venv' and '~/venv/bin/pip install \".[view]\"' in the "
                "sources of riis, and set RIIS_PYTHON=~/venv/bin/python");
  }
  std::vector<char *> words{const_cast<char *>(python.c_str()), const_cast<char *>("-m"), const_cast<char *>("riis")};
  for (int i = 1; i < argc; ++i) words.push_back(argv[i]);
  words.push_back(nullptr);
  execvp(words[0], words.data());
  refuse_data("view: " + python + ": " + system_text(errno));
}

}  // namespace riis::program
