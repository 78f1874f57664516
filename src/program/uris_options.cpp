// SPDX-License-Identifier: Apache-2.0
#include "program/uris_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <set>

#include "program/refusal.hpp"
#include "program/text.hpp"

namespace riis::program {
namespace {

constexpr const char *uris_group = "Export to svMultiPhysics";

const std::set<std::string> of_uris = {"--time-step",    "--opening-seconds", "--closing-seconds",
                                       "--opening-span", "--closing-span",    "--largest-edge"};
const std::set<std::string> with_uris = {
    "--export-uris",     "--valve",        "--params",        "--params-open",  "--set",       "--tolerance",
    "--scale",           "--unit",         "--surface-unit",  "--rotate",       "--translate", "--half-thickness",
    "--resistance",      "--cycle",        "--interpolation", "--period",       "--time-step", "--opening-seconds",
    "--closing-seconds", "--opening-span", "--closing-span",  "--largest-edge", "--quiet",     "--strict"};

[[noreturn]] void refuse_uris(const std::string &text) { throw Refusal{exit_wrong_usage, text}; }

double parse_above_zero(const std::string &text, const std::string &subject) {
  const double number = parse_number(text, subject);
  if (!(number > 0 && std::isfinite(number))) refuse_uris(subject + ": " + text + " is not above 0 and finite");
  return number;
}

TimeSpan parse_span(const std::string &text, const std::string &subject) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || text.find(':', colon + 1) != std::string::npos)
    refuse_uris(subject + ": '" + text + "' is not START:STOP");
  const TimeSpan span{parse_number(text.substr(0, colon), subject), parse_number(text.substr(colon + 1), subject)};
  if (!(std::abs(span.start) <= 1e30 && std::abs(span.stop) <= 1e30))
    refuse_uris(subject + ": " + text + " is not finite and at most 1e30 in magnitude");
  if (!(span.stop > span.start)) refuse_uris(subject + ": the stop of " + text + " is not after its start");
  return span;
}

// The solver takes every blank out of a path.
void check_folder_name(const std::string &folder) {
  const auto is_blank = [](unsigned char c) { return c <= ' ' || c == 127; };
  if (std::any_of(folder.begin(), folder.end(), is_blank))
    refuse_uris("--export-uris: '" + folder + "' has a blank, and svMultiPhysics reads no path with one");
}

void check_motion(const Options &options) {
  const UrisOptions &uris = options.uris;
  const bool has_cycle = !options.series.cycle.empty();
  if (has_cycle && (uris.opening_duration || uris.closing_duration))
    refuse_uris(std::string(uris.opening_duration ? "--opening-seconds" : "--closing-seconds") +
                " has no effect with --cycle: see --opening-span and --closing-span");
  if (!has_cycle && (uris.opening_span || uris.closing_span))
    refuse_uris(std::string(uris.opening_span ? "--opening-span" : "--closing-span") + " needs --cycle");
  if (has_cycle) return;
  if (!uris.opening_duration && !uris.closing_duration)
    refuse_uris("--export-uris needs --opening-seconds and --closing-seconds, or --cycle");
  if (!uris.opening_duration) refuse_uris("--export-uris needs --opening-seconds");
  if (!uris.closing_duration) refuse_uris("--export-uris needs --closing-seconds");
}

}  // namespace

void declare_uris(CLI::App &app, UrisOptions &options, UrisTexts &texts) {
  app.add_option("--export-uris", options.folder,
                 "Write the leaflets' motion as svMultiPhysics reads it, and print Add_URIS_mesh; takes no MESH")
      ->type_name("FOLDER")
      ->group(uris_group)
      ->excludes(app.get_option("--surface"));
  app.add_option("--time-step", texts.time_step, "Time step of the solver, which plays a frame in each")
      ->type_name("DT")
      ->group(uris_group);
  app.add_option("--opening-seconds", texts.opening_duration, "Open from 0 to 1 in this time, by a smooth ramp")
      ->type_name("T")
      ->group(uris_group);
  app.add_option("--closing-seconds", texts.closing_duration, "Close from 1 to 0 in this time")
      ->type_name("T")
      ->group(uris_group);
  app.add_option("--opening-span", texts.opening_span,
                 "Times of --cycle at which the valve opens (default from its least to its largest opening)")
      ->type_name("START:STOP")
      ->group(uris_group);
  app.add_option("--closing-span", texts.closing_span, "Times of --cycle at which the valve closes")
      ->type_name("START:STOP")
      ->group(uris_group);
  app.add_option("--largest-edge", texts.largest_edge, "Cut triangles until no edge is longer in any frame")
      ->type_name("L")
      ->group(uris_group);
}

void parse_uris(const UrisTexts &texts, UrisOptions &options) {
  if (!texts.time_step.empty()) options.time_step = parse_above_zero(texts.time_step, "--time-step");
  if (!texts.opening_duration.empty())
    options.opening_duration = parse_above_zero(texts.opening_duration, "--opening-seconds");
  if (!texts.closing_duration.empty())
    options.closing_duration = parse_above_zero(texts.closing_duration, "--closing-seconds");
  if (!texts.opening_span.empty()) options.opening_span = parse_span(texts.opening_span, "--opening-span");
  if (!texts.closing_span.empty()) options.closing_span = parse_span(texts.closing_span, "--closing-span");
  if (!texts.largest_edge.empty()) options.largest_edge = parse_above_zero(texts.largest_edge, "--largest-edge");
}

void check_uris_purpose(const Options &options, const std::vector<const CLI::Option *> &given) {
  const bool is_wanted = !options.uris.folder.empty();
  for (const CLI::Option *option : given) {
    const std::string name = option->get_name();
    if (!is_wanted && of_uris.count(name) != 0) refuse_uris(name + " needs --export-uris");
    if (is_wanted && with_uris.count(name) == 0) refuse_uris(name + " has no effect with --export-uris");
  }
  if (!is_wanted) return;
  check_folder_name(options.uris.folder);
  for (const std::string &setting : options.settings)
    if (setting.rfind("opening=", 0) == 0) refuse_uris("--set opening has no effect with --export-uris");
  if (!options.uris.time_step) refuse_uris("--export-uris needs --time-step, that of the solver");
  if (!options.resistance) refuse_uris("--export-uris needs --resistance");
  check_motion(options);
}

}  // namespace riis::program
