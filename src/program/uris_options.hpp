// SPDX-License-Identifier: Apache-2.0
// The options of --export-uris: declaring them, parsing their values, and refusing others that have no effect with it.
#pragma once

#include <string>
#include <vector>

#include "program/command_line.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace riis::program {

struct UrisTexts {
  std::string time_step, opening_duration, closing_duration, opening_span, closing_span, largest_edge;
};

void declare_uris(CLI::App &app, UrisOptions &options, UrisTexts &texts);
void parse_uris(const UrisTexts &texts, UrisOptions &options);
// Refuses options without effect in an export, those of an export without one, and an export that lacks some.
void check_uris_purpose(const Options &options, const std::vector<const CLI::Option *> &given);

}  // namespace riis::program
