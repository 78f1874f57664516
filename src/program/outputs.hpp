// SPDX-License-Identifier: Apache-2.0
// The program's outputs. Before any long work the program checks that it can write them. Text goes out whole or fails.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "program/command_line.hpp"
#include "program/output_locks.hpp"

namespace riis::program {

// Throws a Refusal for an output that would replace an input or another output, that has a wrong ending, or whose folder is
// missing or not writable. Throws one also for a picture without a display, and for an output that another run is writing. The
// caller holds the locks until all is written.
// more_inputs are further files that were read.
[[nodiscard]] OutputLocks check_outputs(const Options &options, const std::vector<std::string> &more_inputs = {});

// Whether the path ends so, in capitals or not.
bool has_ending(const std::string &path, const std::string &ending);
// place_of returns the place of the file itself: links to existing files are followed. folder_of returns its folder, or "." if
// it names none.
std::filesystem::path place_of(const std::string &path);
std::filesystem::path folder_of(const std::filesystem::path &place);

// Throws a Refusal for an output that is one of these files, and says what they are.
void check_no_output_is(const std::string &what, const std::vector<std::string> &files, const Options &options);

// Whether a later text can take an earlier one's place: not on stdout, in a device or in a pipe.
bool can_be_replaced(const std::string &path);
// "-" is stdout. Afterwards a file is complete or as it was before.
void write_text(const std::string &path, const std::string &text);

}  // namespace riis::program
