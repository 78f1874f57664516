// SPDX-License-Identifier: Apache-2.0
// In: argc and argv. Out: the command and its options.
#pragma once

#include <optional>
#include <variant>

#include "program/base/options.hpp"

namespace riis::program {

// The command that the user requested, with its options. The commands riis surface and riis check also use MarkOptions.
using Request = std::variant<MarkOptions, SizeFieldOptions, StatesOptions, ExportOptions, ParamsOptions, PlaceOptions>;

// Parses the command line. If the user requests only help or the version, prints this text and returns nothing. Throws a Refusal
// for wrong usage.
std::optional<Request> parse_command_line(int argc, char **argv);

}  // namespace riis::program
