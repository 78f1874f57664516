// SPDX-License-Identifier: Apache-2.0
// The program riis, from the command line to an exit status. Every error is reported in one line on stderr. Without arguments the
// program prints a few lines of help on stderr.
#include <fcntl.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <iostream>
#include <string>

#include "program/base/ranks.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/cli/command_line.hpp"
#include "program/commands/commands.hpp"

namespace {

// Names of files and parameters may contain line breaks. Other characters replace the line breaks, so that the message stays on
// one line.
int give_up(int exit_code, std::string text) {
  std::replace_if(text.begin(), text.end(), riis::program::is_control, '?');
  std::cerr << "riis: " << text << std::endl;
  return exit_code;
}

// Opens a substitute for each standard stream that is closed. Without a substitute, the next file to be opened would get the
// number of the closed stream, and the program would print into this file. A substitute is opened for reading only, so printing
// to it fails.
void occupy_closed_streams() {
  for (const int stream : {0, 1, 2}) {
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", O_RDONLY);
  }
}

int run_and_report(int argc, char **argv) {
  using namespace riis::program;
  Refusal failure{exit_fine, ""};
  try {
    ExitCode code = exit_fine;
    try {
      if (argc < 2) {
        if (ranks::is_first()) std::cerr << short_help();
        return exit_wrong_usage;
      }
      const auto request = parse_command_line(argc, argv);
      if (request) code = run(*request);
    } catch (const Refusal &refusal) {
      failure = refusal;
    } catch (const std::bad_alloc &) {
      failure = {exit_bad_data, "out of memory"};
    } catch (const std::exception &error) {
      failure = {exit_bad_data, error.what()};
    }
    ranks::agree(failure.exit_code == exit_fine ? nullptr : &failure);
    return code;
  } catch (const ranks::AgreedRefusal &agreed) {
    return ranks::is_first() ? give_up(agreed.refusal.exit_code, agreed.refusal.text) : agreed.refusal.exit_code;
  }
}

}  // namespace

int main(int argc, char **argv) {
  occupy_closed_streams();
  // Ignores SIGXFSZ. A write beyond the limit of file sizes then fails without ending the process.
  std::signal(SIGXFSZ, SIG_IGN);
  const riis::program::ranks::Session session(&argc, &argv);
  return run_and_report(argc, argv);
}
