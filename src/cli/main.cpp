// SPDX-License-Identifier: Apache-2.0
// riis-mark: from the command line to an exit status. Whatever goes wrong ends in one line on stderr.
#include <exception>
#include <iostream>
#include <string>

#include "cli/command_line.hpp"
#include "cli/refusal.hpp"
#include "cli/run.hpp"

namespace {

int give_up(int exit_code, const std::string &text) {
  std::cerr << "riis-mark: " << text << std::endl;
  return exit_code;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    if (const auto options = riis::cli::parse_command_line(argc, argv)) riis::cli::run(*options);
    return riis::cli::exit_fine;
  } catch (const riis::cli::Refusal &refusal) {
    return give_up(refusal.exit_code, refusal.text);
  } catch (const std::bad_alloc &) {
    return give_up(riis::cli::exit_bad_data, "out of memory");
  } catch (const std::exception &error) {
    return give_up(riis::cli::exit_bad_data, error.what());
  }
}
