// SPDX-License-Identifier: Apache-2.0
#include "program/input/case.hpp"

#include <algorithm>
#include <utility>

#include "program/input/opening_law.hpp"
#include "program/output/outputs.hpp"

namespace riis::program {
namespace {

OpeningLaw law_of_command_line(const MarkOptions &options) {
  const SeriesOptions &series = options.series;
  OpeningTable table = read_cycle(series.cycle);
  table.period = options.period;
  table.interpolation = series.interpolation;
  return OpeningLaw(std::move(table), series.cycle);
}

void read_valve(const MarkOptions &options, ValveSource &source) {
  source.has_open_state = !options.params_open.empty();
  if (options.series.times.empty()) {
    source.valve = make_valve(options);
    source.law = OpeningLaw(opening_of(source.valve.get()));
    return;
  }
  source.law = law_of_command_line(options);
  // make_valve refuses a file of patches if the valve cannot open as far as the law requires.
  source.options.opening = largest_opening(source.law, options.series.times);
  source.valve = make_valve(source.options, OpeningCheck::yes, &source.warp);
}

}  // namespace

bool Case::has_resistance() const {
  return std::any_of(valves.begin(), valves.end(),
                     [](const ValveSource &valve) { return valve.options.resistance.has_value(); });
}

std::vector<double> Case::times() const {
  return is_series() ? options.series.times : std::vector<double>{options.time.value_or(0)};
}

std::string Case::surface_of(std::size_t valve) const {
  return valves.size() == 1 ? "the surface" : "the surface of " + part_of(valve);
}

Case case_of_command_line(const MarkOptions &options) {
  Case all{options, {}, {}};
  ValveSource source{options, nullptr, nullptr};
  if (options.surface.empty()) read_valve(options, source);
  all.valves.push_back(std::move(source));
  if (all.is_series()) read_surfaces(all);
  return all;
}

void read_surfaces(Case &all) {
  for (ValveSource &source : all.valves) {
    const MarkOptions &options = source.options;
    if (source.valve || source.file || source.keyframes) continue;
    if (!is_motion_file(options.surface)) {
      source.file = read_surface(options, all.seconds);
      continue;
    }
    KeyframeFiles read = read_keyframes(options, all.seconds);
    // Outputs are written after all frames are read, so the user would not notice that one replaces a frame.
    check_no_output_is("a frame of --surface " + options.surface, read.files, options);
    source.keyframes = std::move(read.keyframes);
    all.files.insert(all.files.end(), read.files.begin(), read.files.end());
  }
}

}  // namespace riis::program
