// SPDX-License-Identifier: Apache-2.0
// Runs other programs without a shell.
#pragma once

#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace riis::program {

struct CloseFile {
  void operator()(std::FILE *file) const { std::fclose(file); }
};
// A file without a name. When the file is closed, the system removes it.
using TemporaryFile = std::unique_ptr<std::FILE, CloseFile>;
// Makes a temporary file. If the file cannot be made, returns NULL and sets errno.
TemporaryFile temporary_file();

struct ProgramEnd {
  int error = 0;                        // why the program could not be run, as errno has it, or 0
  int status = -1;                      // its exit status, or -1 if a signal ended it
  std::string last_message{};           // the last line on its stderr
  std::vector<std::string> messages{};  // all these lines
};
// Runs the program whose name is the first word, and waits until the program ends. A name without a slash is looked for in PATH.
// The started program reads the file `input` from the file's present position, or nothing if `input` is NULL. run_program passes
// each line of the output to `read`.
ProgramEnd run_program(
    const std::vector<std::string> &words, std::FILE *input = nullptr,
    const std::function<void(const std::string &)> &read = [](const std::string &) {});

// Looks for the program with the given name in PATH. Returns its path, or "" if PATH has no such program.
std::string program_on_path(const std::string &name);

// Returns the command that starts Python: `python3`, or the value of the environment variable RIIS_PYTHON.
std::string python_of_user();

// Implements `riis view`: this process becomes `python3 -m riis view` with the words of the command line. The function never
// returns. If the Python package riis is missing, a Refusal says how to install it.
[[noreturn]] void run_view(int argc, char **argv);

}  // namespace riis::program
