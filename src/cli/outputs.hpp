// SPDX-License-Identifier: Apache-2.0
// The program's outputs. Before any long work the program checks that it can write them. Text goes out whole or fails.
#pragma once

#include <string>
#include <vector>

#include "cli/command_line.hpp"

namespace riis::cli {

// Throws a Refusal for an output that would replace an input or another output, that has a wrong ending, or whose folder is
// missing or not writable. Throws one also for a picture without a display.
void check_outputs(const Options &options);

// Throws a Refusal for an output that is one of these files, and says what they are.
void check_no_output_is(const std::string &what, const std::vector<std::string> &files, const Options &options);

// "-" is stdout. Afterwards a file is complete or as it was before.
void write_text(const std::string &path, const std::string &text);

}  // namespace riis::cli
