// SPDX-License-Identifier: Apache-2.0
// The options of --states: declaring them, parsing their values, and refusing others that have no effect with it.
#pragma once

#include <string>
#include <vector>

#include "program/command_line.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace riis::program {

// The most openings of --states.
inline constexpr std::int32_t most_states = 100001;

void declare_states(CLI::App &app, Options &options, std::string &count);
void parse_states(const std::string &count, Options &options);
void check_states_purpose(const Options &options, const std::vector<const CLI::Option *> &given);

}  // namespace riis::program
