// SPDX-License-Identifier: Apache-2.0
#include "program/other_program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>

#include "program/refusal.hpp"

extern char **environ;

namespace riis::program {

ProgramEnd run_program(const std::vector<std::string> &words, const std::string &log) {
  std::vector<char *> arguments;
  for (const std::string &word : words) arguments.push_back(const_cast<char *>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  if (posix_spawn_file_actions_init(&actions) != 0) throw std::bad_alloc();
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t process = 0;
  const int error = posix_spawnp(&process, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return {error, -1};
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return {0, -1};
  return {0, WIFEXITED(status) ? WEXITSTATUS(status) : -1};
}

void run_view(int argc, char **argv) {
  const char *named = std::getenv("RIIS_PYTHON");
  const std::string python = named != nullptr && named[0] != '\0' ? named : "python3";
  const std::string looks_for_package =
      "import importlib.util as u, sys; sys.exit(0 if u.find_spec('riis') and u.find_spec('riis.__main__') else 3)";
  const ProgramEnd end = run_program({python, "-c", looks_for_package}, "/dev/null");
  if (end.error != 0 || end.status != 0) {
    const char *const fault = end.error != 0    ? " cannot be run"
                              : end.status == 3 ? " does not find the Python package riis"
                                                : " fails when it imports the Python package riis";
    throw Refusal{exit_bad_data,
                  "view: " + python + fault +
                      "; install it by 'python3 -m venv ~/venv' and '~/venv/bin/pip install \".[view]\"' in the "
                      "sources of riis, and set RIIS_PYTHON=~/venv/bin/python"};
  }
  std::vector<char *> words{const_cast<char *>(python.c_str()), const_cast<char *>("-m"), const_cast<char *>("riis")};
  for (int i = 1; i < argc; ++i) words.push_back(argv[i]);
  words.push_back(nullptr);
  execvp(words[0], words.data());
  throw Refusal{exit_bad_data, "view: " + python + ": " + std::strerror(errno)};
}

}  // namespace riis::program
