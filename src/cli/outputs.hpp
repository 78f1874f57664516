// SPDX-License-Identifier: Apache-2.0
// The program's outputs: whether they can be written is checked before any long work, and text goes out whole or fails.
#pragma once

#include <string>

#include "cli/command_line.hpp"

namespace riis::cli {

// Throws a Refusal for an output that would replace an input or another output, whose ending is wrong or whose folder is
// missing or not writable, and for a picture without a display.
void check_outputs(const Options &options);

// "-" is stdout. A file is complete or as it was before.
void write_text(const std::string &path, const std::string &text);

}  // namespace riis::cli
