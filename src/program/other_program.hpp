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

}  // namespace riis::program
