// SPDX-License-Identifier: Apache-2.0
// The texts of the program's help.
#pragma once

#include <string>

namespace riis::program {

extern const char *const description;

// Returns the text that follows the options in a command's help: examples, and topics to read. The name "riis" stands for the
// program's own help.
std::string help_of(const std::string &command);

// Returns the text of a topic, or the list of topics if the name is "". Throws a Refusal for an unknown name.
std::string text_of_topic(const std::string &name);

// Returns the lines that are printed for a command line without arguments.
std::string short_help();

}  // namespace riis::program
