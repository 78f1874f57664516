// SPDX-License-Identifier: Apache-2.0
// The program riis, from the command line to an exit status. Every error ends as one line on stderr. Without arguments the
// program prints a few lines of help on stderr.
#include <fcntl.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <iostream>
#include <string>

#include "program/command_line.hpp"
#include "program/help.hpp"
#include "program/refusal.hpp"
#include "program/run.hpp"

namespace {

// Names of files and parameters may contain line breaks. They are replaced, so that the message stays on one line.
int give_up(int exit_code, std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  std::cerr << "riis: " << text << std::endl;
  return exit_code;
}

// Opens a substitute for each standard stream that is closed. Otherwise the next file to be opened would get the stream's
// number, and prints would go into that file. The substitute is opened for reading, so prints to it fail.
void occupy_closed_streams() {
  for (const int stream : {0, 1, 2}) {
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", O_RDONLY);
  }
}

}  // namespace

int main(int argc, char **argv) {
  occupy_closed_streams();
  // Ignores SIGXFSZ. So a write beyond the limit of file sizes fails instead of ending the process.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    if (argc < 2) {
      std::cerr << riis::program::short_help();
      return riis::program::exit_wrong_usage;
    }
    const auto request = riis::program::parse_command_line(argc, argv);
    return request ? riis::program::run(*request) : riis::program::exit_fine;
  } catch (const riis::program::Refusal &refusal) {
    return give_up(refusal.exit_code, refusal.text);
  } catch (const std::bad_alloc &) {
    return give_up(riis::program::exit_bad_data, "out of memory");
  } catch (const std::exception &error) {
    return give_up(riis::program::exit_bad_data, error.what());
  }
}
