// SPDX-License-Identifier: Apache-2.0
// The program's outputs: whether they can be written is checked before any long work, and text goes out whole or fails.
#pragma once

#include <string>

#include "cli/command_line.hpp"

namespace riis::cli {

// Throws a Refusal for the first output whose ending is wrong or whose folder is missing or not writable.
void check_outputs(const Options &options);

// "-" is stdout.
void write_text(const std::string &path, const std::string &text);

}  // namespace riis::cli
