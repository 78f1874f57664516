// SPDX-License-Identifier: Apache-2.0
// What the program says of itself.
#pragma once

#include <string>

namespace riis::program {

extern const char *const description;

// What stands below the options of a command: examples, and where to read on. "riis" is the program's own.
std::string help_of(const std::string &command);

// The text of a topic, or the list of topics for "". Throws a Refusal for another name.
std::string text_of_topic(const std::string &name);

// The lines for a command line without arguments.
std::string short_help();

}  // namespace riis::program
