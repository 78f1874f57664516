// SPDX-License-Identifier: Apache-2.0
// In: argc and argv. Out: the command and its options.
#pragma once

#include <optional>
#include <variant>

#include "program/options.hpp"

namespace riis::program {

// The request of a command line. riis surface and riis check also have MarkOptions.
using Request = std::variant<MarkOptions, StatesOptions, ExportOptions, ParamsOptions>;

// Prints help or the version and returns nothing if the command line requests only that. Throws a Refusal for wrong usage.
std::optional<Request> parse_command_line(int argc, char **argv);

}  // namespace riis::program
