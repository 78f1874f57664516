// SPDX-License-Identifier: Apache-2.0
// Runs other programs without a shell.
#pragma once

#include <string>
#include <vector>

namespace riis::program {

struct ProgramEnd {
  int error;   // why the program could not be run, as errno has it, or 0
  int status;  // its exit status, or -1 if a signal ended it
};
// Runs the words as a program and waits for its end. A first word without a slash is looked for in PATH. The program reads
// nothing, its output is lost, and its messages are written to a file.
ProgramEnd run_program(const std::vector<std::string> &words, const std::string &log);

// Implements `riis view`: replaces this process by `python3 -m riis view` with the same words. Returns only by a Refusal, which
// says how to install the Python package riis if it is missing. The environment variable RIIS_PYTHON names another Python.
[[noreturn]] void run_view(int argc, char **argv);

}  // namespace riis::program
