// SPDX-License-Identifier: Apache-2.0
#include "program/view.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "program/other_program.hpp"
#include "program/refusal.hpp"

namespace riis::program {

void run_view(int argc, char **argv) {
  const char *named = std::getenv("RIIS_PYTHON");
  const std::string python = named != nullptr && named[0] != '\0' ? named : "python3";
  const std::string looks_for_package =
      "import importlib.util as u, sys; sys.exit(0 if u.find_spec('riis') and u.find_spec('riis.__main__') else 3)";
  const int status = run_program({python, "-c", looks_for_package}, "/dev/null").status;
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
