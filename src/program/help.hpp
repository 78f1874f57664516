// SPDX-License-Identifier: Apache-2.0
// The prose of --help, before and behind the options.
#pragma once

#include <string>

namespace riis::program {

extern const char *const description;
extern const char *const footer;

// For a command line without arguments: the purpose of the program, in five lines.
std::string short_help();

}  // namespace riis::program
