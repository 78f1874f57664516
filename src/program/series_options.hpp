// SPDX-License-Identifier: Apache-2.0
// The options of a series and of cases: declaring them, parsing their values, and refusing others that go with neither.
#pragma once

#include <string>
#include <vector>

#include "program/command_line.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace riis::program {

struct SeriesTexts {
  std::string times, interpolation, frame_rate, movie_view;
};

void declare_series(CLI::App &app, SeriesOptions &options, SeriesTexts &texts);
void parse_series(const SeriesTexts &texts, SeriesOptions &options);
// Refuses options without effect in a series or a case, and those of a series without one.
void check_series_purpose(const Options &options, const std::vector<const CLI::Option *> &given);

}  // namespace riis::program
