// SPDX-License-Identifier: Apache-2.0
#include "program/series_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <set>

#include "program/opening_law.hpp"
#include "program/refusal.hpp"
#include "program/text.hpp"
#include "program/valve_source.hpp"

namespace riis::program {
namespace {

constexpr const char *series_group = "Series in time, and several valves";

const std::set<std::string> of_series = {"--cycle", "--movie", "--frame-rate", "--series-table", "--all-cells"};
// A case says these itself.
const std::set<std::string> not_with_case = {
    "--surface",         "--leaflets", "--valve",        "--opening",       "--params",         "--params-closed",
    "--params-open",     "--set",      "--tolerance",    "--triangulation", "--skip-zero-area", "--flip-normals",
    "--scale",           "--unit",     "--surface-unit", "--rotate",        "--translate",      "--half-thickness",
    "--resistance",      "--cycle",    "--period",       "--interpolation", "--prefix",         "--print-params",
    "--describe-params", "--time"};
const std::set<std::string> not_with_either = {
    "--steps", "--stats", "--search", "--distance", "--distance-tolerance", "--check-crossing"};
const std::set<std::string> not_with_times = {"--opening", "--print-params", "--describe-params"};

[[noreturn]] void refuse_usage(const std::string &text) { throw Refusal{exit_wrong_usage, text}; }

double parse_positive(const std::string &text, const std::string &subject) {
  const double number = parse_number(text, subject);
  if (!(number > 0 && std::isfinite(number))) refuse_usage(subject + ": " + text + " is not above 0 and finite");
  return number;
}

void declare_movie(CLI::App &app, SeriesOptions &options, SeriesTexts &texts) {
  CLI::Option *movie = app.add_option("--movie", options.movie, "Draw each time and make a movie of it, by ffmpeg")
                           ->type_name("OUT.mp4|OUT.gif")
                           ->group(series_group);
  app.add_option("--frame-rate", texts.frame_rate, "Frames of the movie a second (default 10)")
      ->type_name("N")
      ->group(series_group)
      ->needs(movie);
  app.add_option("--movie-view", texts.movie_view, "View of the movie: side, top or oblique (default)")
      ->type_name("VIEW")
      ->check(CLI::IsMember(view_names()))
      ->group(series_group)
      ->needs(movie);
}

std::int32_t position_among(const std::string &name, const std::vector<std::string> &names) {
  return static_cast<std::int32_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

void declare_series(CLI::App &app, SeriesOptions &options, SeriesTexts &texts) {
  app.add_option("--times", texts.times, "Mark at each of these times; --output and --surface-output then take a .pvd")
      ->type_name("START:STOP:STEP|T,T,...")
      ->group(series_group);
  CLI::Option *cycle = app.add_option("--cycle", options.cycle, "Times and openings of the valve, in two columns")
                           ->type_name("FILE.csv")
                           ->group(series_group);
  app.add_option("--interpolation", texts.interpolation,
                 "Between the times of the cycle: linear (default) or cubic, monotone")
      ->type_name("HOW")
      ->check(CLI::IsMember(interpolation_names()))
      ->group(series_group)
      ->needs(cycle);
  app.add_option("--case", options.case_file,
                 "Valves, placements, cycles and times from a file, in place of the options above")
      ->type_name("FILE.json")
      ->group(series_group)
      ->excludes(cycle);
  app.add_flag("--all-cells", options.all_cells, "Write the whole mesh each time, not only the cells near the sweep")
      ->group(series_group);
  app.add_option("--series-table", options.table,
                 "Write time, opening, marked nodes, largest speed and seconds of each step")
      ->type_name("OUT.csv")
      ->group(series_group);
  declare_movie(app, options, texts);
}

void parse_series(const SeriesTexts &texts, SeriesOptions &options) {
  if (!texts.times.empty()) options.times = parse_times(texts.times, "--times");
  if (!texts.frame_rate.empty()) options.frame_rate = parse_positive(texts.frame_rate, "--frame-rate");
  if (!texts.interpolation.empty()) options.interpolation = position_among(texts.interpolation, interpolation_names());
  if (!texts.movie_view.empty()) options.movie_view = position_among(texts.movie_view, view_names());
}

void check_series_purpose(const Options &options, const std::vector<const CLI::Option *> &given) {
  const SeriesOptions &series = options.series;
  const bool has_case = !series.case_file.empty(), has_times = !series.times.empty();
  for (const CLI::Option *option : given) {
    const std::string name = option->get_name();
    if (!has_case && !has_times && of_series.count(name) != 0) refuse_usage(name + " needs --times");
    if (has_case && not_with_case.count(name) != 0)
      refuse_usage(name + " has no effect with --case, which says it itself");
    if ((has_case || has_times) && not_with_either.count(name) != 0)
      refuse_usage(name + " has no effect with " + (has_case ? "--case" : "--times"));
    if (has_times && !has_case && not_with_times.count(name) != 0) refuse_usage(name + " has no effect with --times");
  }
  if (!has_times || has_case) return;
  if (options.mesh.empty()) refuse_usage("--times needs a MESH");
  if (!options.surface.empty()) {
    if (!series.cycle.empty()) refuse_usage("--cycle has no effect with --surface");
    if (!is_motion_file(options.surface))
      refuse_usage("--times has no effect with --surface " + options.surface + ": a motion is a .pvd file");
    return;
  }
  if (series.cycle.empty()) refuse_usage("--times needs --cycle, the valve's opening in time");
  for (const std::string &setting : options.settings)
    if (setting.rfind("opening=", 0) == 0) refuse_usage("--set opening has no effect with --times: see --cycle");
}

}  // namespace riis::program
