// SPDX-License-Identifier: Apache-2.0
// The texts of the program's help.
#pragma once

#include <string>

namespace riis::program {

extern const char *const description;

// Returns the text below the options of a command: examples, and the topics to read. "riis" is the name for the program's own
// help.
std::string help_of(const std::string &command);

// Returns the text of a topic, or the list of topics for "". Throws a Refusal for another name.
std::string text_of_topic(const std::string &name);

// Returns the lines for a command line without arguments.
std::string short_help();

}  // namespace riis::program
