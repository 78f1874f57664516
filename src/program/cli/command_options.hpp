// SPDX-License-Identifier: Apache-2.0
// Declares the options of each command, and checks that they fit together.
#pragma once

#include <cstdint>

#include "program/base/options.hpp"
#include "program/cli/command.hpp"

namespace riis::program {

// The largest number of openings that riis states accepts.
inline constexpr std::int32_t most_states = 100001;

void declare_mark(Command command, MarkOptions &options);
void declare_surface(Command command, MarkOptions &options);
void declare_crossings(Command command, MarkOptions &options);
void declare_leaks(Command command, MarkOptions &options);
void declare_size_field(Command command, SizeFieldOptions &options);
void declare_states(Command command, StatesOptions &options);
void declare_export(Command command, ExportOptions &options);
void declare_params(Command command, ParamsOptions &options);
void declare_place(Command command, PlaceOptions &options);

// Each finish_* function refuses options that contradict each other or have no effect, and derives the remaining values.
MarkOptions finish_mark(const Command &command, MarkOptions options);
MarkOptions finish_surface(const Command &command, MarkOptions options);
MarkOptions finish_crossings(const Command &command, MarkOptions options);
MarkOptions finish_leaks(const Command &command, MarkOptions options);
SizeFieldOptions finish_size_field(const Command &command, SizeFieldOptions options);
StatesOptions finish_states(const Command &command, StatesOptions options);
ExportOptions finish_export(const Command &command, ExportOptions options);
ParamsOptions finish_params(const Command &command, ParamsOptions options);
PlaceOptions finish_place(const Command &command, PlaceOptions options);

}  // namespace riis::program
