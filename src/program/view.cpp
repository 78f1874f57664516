// SPDX-License-Identifier: Apache-2.0
#include "program/view.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "program/refusal.hpp"

extern char **environ;

namespace riis::program {
namespace {

// Runs the words as a program that is looked for in PATH, without messages. Returns its exit status, or -1 if it cannot be run.
int status_of(const std::vector<const char *> &words) {
  posix_spawn_file_actions_t files;
  if (posix_spawn_file_actions_init(&files) != 0) return -1;
  pid_t child = 0;
  const bool started =
      posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0) == 0 &&
      posix_spawnp(&child, words[0], &files, nullptr, const_cast<char *const *>(words.data()), environ) == 0;
  posix_spawn_file_actions_destroy(&files);
  if (!started) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

void run_view(int argc, char **argv) {
  const char *named = std::getenv("RIIS_PYTHON");
  const std::string python = named != nullptr && named[0] != '\0' ? named : "python3";
  const int status =
      status_of({python.c_str(), "-c",
                 "import importlib.util as u, sys; sys.exit(0 if u.find_spec('riis') and u.find_spec('riis.__main__') "
                 "else 3)",
                 nullptr});
  if (status != 0) {
    throw Refusal{exit_bad_data,
                  (status == 3 ? "view: " + python + " does not find the Python package riis"
                               : "view: " + python + " cannot be run") +
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
