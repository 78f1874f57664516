// SPDX-License-Identifier: Apache-2.0
// In: argc and argv. Out: the command and its options.
#pragma once

#include <optional>
#include <variant>

#include "program/options.hpp"

namespace riis::program {

// What a command line asks for. riis surface and riis check are runs of MarkOptions.
using Request = std::variant<MarkOptions, StatesOptions, ExportOptions, ParamsOptions>;

// Returns nothing if the command line asked only for help or the version, which it has then printed.
// Throws a Refusal for wrong usage.
std::optional<Request> parse_command_line(int argc, char **argv);

}  // namespace riis::program
