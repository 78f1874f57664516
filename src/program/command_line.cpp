// SPDX-License-Identifier: Apache-2.0
#include "program/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <utility>

#include "common/nearest_name.hpp"
#include "program/help.hpp"
#include "program/leaks.hpp"
#include "program/outputs.hpp"
#include "program/refusal.hpp"
#include "program/series_options.hpp"
#include "program/state_options.hpp"
#include "program/text.hpp"
#include "program/uris_options.hpp"
#include "program/valve_file.hpp"
#include "program/valve_source.hpp"

namespace riis::program {
namespace {

// Each name stands at the position of its RIIS_SEARCH_*.
const std::vector<std::string> search_names = {"auto", "exhaustive", "neighbor", "paper", "clusters"};

// Each name stands at the position of its RIIS_DISTANCE_*.
const std::vector<std::string> distance_names = {"triangles", "sampling", "minimization"};

// CLI11 collects text; numbers are parsed here, whatever the locale.
struct Texts {
  std::string scale, rotate, translate, half_thickness, distance_limit, far_distance, tolerance, threads, opening,
      resistance;
  std::string measure_tolerance, unit, surface_unit, steps, time, period, state_count;
  SeriesTexts series;
  UrisTexts uris;
  std::string search = search_names[RIIS_SEARCH_AUTO];
  std::string triangulation = triangulation_names()[RIIS_TRIANGULATION_ADAPTED];
  std::string distance = distance_names[RIIS_MEASURE_TRIANGLES];
  std::vector<std::string> pictures, views, check_leaks;
  bool skip_zero_area = false;
  bool flip_normals = false;
};

int32_t position_of(const std::string &name, const std::vector<std::string> &names) {
  return static_cast<int32_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

void declare_motion(CLI::App &app, Texts &texts, CLI::Option *surface) {
  const char *group = "Surface";
  app.add_option("--time", texts.time, "Time at which to take a motion, --surface FILE.pvd")
      ->type_name("T")
      ->group(group)
      ->needs(surface);
  app.add_option("--period", texts.period,
                 "Period of that motion or of --cycle; without one it rests before its first and behind its last time")
      ->type_name("P")
      ->group(group);
}

void declare_surface(CLI::App &app, Options &options, Texts &texts) {
  const char *group = "Surface";
  CLI::Option *surface =
      app.add_option("--surface", options.surface,
                     "Surface from a file (.vtp, .vtu, .stl) in place of a valve, or its motion from a .pvd file")
          ->type_name("FILE")
          ->group(group);
  app.add_option("--leaflets", options.leaflets,
                 "Leaflets of --surface: its connected pieces, or the values of a cell array (default riis_leaflet, if "
                 "present)")
      ->type_name("connected|ARRAY")
      ->group(group)
      ->needs(surface);
  app.add_option(
         "--valve", options.valve,
         "Kind of the parametric valve, aortic (default), mitral, trileaflet or bileaflet, or a file of patches")
      ->type_name("KIND|FILE.json")
      ->group(group)
      ->excludes(surface);
  app.add_option("--opening", texts.opening, "How far the valve is open, from 0, closed, to 1, open")
      ->type_name("X")
      ->group(group)
      ->excludes(surface);
  app.add_option("--params,--params-closed", options.params,
                 "Valve parameters from a JSON file; those of the closed state")
      ->type_name("FILE.json")
      ->group(group)
      ->excludes(surface);
  app.add_option("--params-open", options.params_open, "Valve parameters of the state that --opening opens to")
      ->type_name("FILE.json")
      ->group(group)
      ->excludes(surface);
  app.add_option("--set", options.settings, "Set one valve parameter to a number or X,Y,Z; may be repeated")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false)
      ->group(group)
      ->excludes(surface);
  app.add_flag("--print-params", options.print_params,
               "Apply --params, --set and --opening, print all valve parameters as JSON for --params, and exit")
      ->group(group)
      ->excludes(surface);
  app.add_flag("--describe-params", options.describe_params,
               "Print the same parameters as a table, with units, ranges and descriptions, and exit")
      ->group(group)
      ->excludes(surface)
      ->excludes(app.get_option("--print-params"));
  app.add_option("--tolerance", texts.tolerance,
                 "Largest deviation of triangles from the smooth valve, in half thicknesses (default 0.05)")
      ->type_name("F")
      ->group(group)
      ->excludes(surface);
  app.add_option(
         "--triangulation", texts.triangulation,
         "Triangles of a valve that moves: adapted to each opening (default), or fixed, the same at every opening")
      ->type_name("HOW")
      ->check(CLI::IsMember(triangulation_names()))
      ->group(group)
      ->excludes(surface);
  app.add_flag("--skip-zero-area", texts.skip_zero_area,
               "Leave out triangles of --surface that have no area, in place of refusing them")
      ->group(group)
      ->needs(surface);
  app.add_flag("--flip-normals", texts.flip_normals, "Turn every triangle over")->group(group);
  app.add_flag("--check-crossing", options.check_crossing,
               "Tell whether leaflets go through each other, at 101 openings of a valve that opens, or at --opening")
      ->group(group);
  declare_motion(app, texts, surface);
}

void declare_placement(CLI::App &app, Texts &texts) {
  const char *group = "Placement: x -> scale * rotation * x + translation";
  CLI::Option *scale =
      app.add_option("--scale", texts.scale, "Factor from the surface's unit to the mesh's (default 1)")
          ->type_name("S")
          ->group(group);
  app.add_option("--unit", texts.unit, "Unit of the mesh, in place of --scale")
      ->type_name("UNIT")
      ->check(CLI::IsMember(unit_names()))
      ->group(group)
      ->excludes(scale);
  app.add_option("--surface-unit", texts.surface_unit, "Unit of the file that holds the surface or the patches")
      ->type_name("UNIT")
      ->check(CLI::IsMember(unit_names()))
      ->group(group);
  app.add_option("--rotate", texts.rotate, "Rotate about an axis by an angle in degrees")
      ->type_name("X,Y,Z,DEG")
      ->group(group);
  app.add_option("--translate", texts.translate, "Translate by a vector in the mesh's unit")
      ->type_name("X,Y,Z")
      ->group(group);
}

void declare_marking(CLI::App &app, Texts &texts) {
  const char *group = "Marking";
  app.add_option("--half-thickness", texts.half_thickness,
                 "Mark nodes up to this distance (default 0.1 times the scale; with --unit 0.1 cm)")
      ->type_name("L")
      ->group(group);
  app.add_option("--distance-limit", texts.distance_limit,
                 "Report distances up to this one (default the half thickness)")
      ->type_name("L")
      ->group(group);
  app.add_option(
         "--resistance", texts.resistance,
         "Write riis_resistance, K of each node: R/eps times the delta function, for this R in mass/(length time)")
      ->type_name("R")
      ->group(group);
  app.add_option("--far-distance", texts.far_distance, "riis_distance of nodes beyond the limit (default 1e30)")
      ->type_name("X")
      ->group(group);
  app.add_option("--distance", texts.distance, "Measure distances by triangles (default), sampling or minimization")
      ->type_name("HOW")
      ->check(CLI::IsMember(distance_names))
      ->group(group)
      ->excludes(app.get_option("--surface"));
  app.add_option("--distance-tolerance", texts.measure_tolerance,
                 "Tolerance of --distance sampling or minimization, in half thicknesses (default --tolerance)")
      ->type_name("F")
      ->group(group);
  app.add_option("--search", texts.search, "Search by auto (default), exhaustive, neighbor, clusters or paper")
      ->type_name("HOW")
      ->check(CLI::IsMember(search_names))
      ->group(group);
  app.add_option("--check-leaks", texts.check_leaks,
                 "Say whether unmarked nodes join these two points, where, and which half thickness parts them")
      ->type_name("X,Y,Z X,Y,Z")
      ->expected(2)
      ->multi_option_policy(CLI::MultiOptionPolicy::Throw)
      ->group(group);
  app.add_option("--threads", texts.threads,
                 "Number of threads (default as many as the work feeds, at most one a processor)")
      ->type_name("N")
      ->group(group);
}

void declare_steps(CLI::App &app, Texts &texts) {
  app.add_option("--steps", texts.steps,
                 "Also time N steps of a moving valve: each changes the opening by 0.02 and marks the nodes again")
      ->type_name("N")
      ->group("Marking")
      ->excludes(app.get_option("--surface"));
}

int32_t parse_steps(const std::string &text) {
  if (text.empty()) return 0;
  const int32_t n = parse_integer(text, "--steps");
  if (n < 1) throw Refusal{exit_wrong_usage, "--steps: " + text + " is not above 0"};
  return n;
}

void declare_output(CLI::App &app, Options &options, Texts &texts) {
  const char *group = "Output";
  CLI::Option *output =
      app.add_option("--output", options.output, "Write the marked mesh")->type_name("OUT.vtu")->group(group);
  app.add_option("--prefix", options.prefix,
                 "Name the arrays of the marked mesh NAME_marked, NAME_distance, NAME_leaflet (default riis)")
      ->type_name("NAME")
      ->group(group)
      ->needs(output);
  app.add_flag("--replace", options.replace, "Replace arrays of these names that the mesh already has")
      ->group(group)
      ->needs(output);
  app.add_flag("--allow-none", options.allow_none, "Exit with status 0 and without a warning if no node is marked")
      ->group(group);
  app.add_option("--surface-output", options.surface_output, "Write the placed triangles")
      ->type_name("OUT.vtp")
      ->group(group);
  app.add_option("--picture", texts.pictures, "Draw the surface and the marked cells side by side; may be repeated")
      ->type_name("OUT.png")
      ->allow_extra_args(false)
      ->group(group);
  app.add_option("--view", texts.views,
                 "View of a --picture, side, top or oblique (default); one for each, in their order")
      ->type_name("VIEW")
      ->allow_extra_args(false)
      ->check(CLI::IsMember(view_names()))
      ->group(group);
  app.add_option("--stats", options.stats,
                 "Write counts and seconds as JSON; - is stdout, which then holds nothing else")
      ->type_name("FILE.json|-")
      ->group(group);
  app.add_flag("--quiet", options.quiet, "Print no table on stdout and no progress on stderr; warnings stay")
      ->group(group);
  app.add_flag("--strict", options.strict, "Exit with status 4 if there was a warning")->group(group);
}

// RIIS_AUTO is a negative number, and a user's number must not pass for it.
double parse_length(const std::string &text, const std::string &subject) {
  const double length = parse_number(text, subject);
  if (!(length > 0)) throw Refusal{exit_wrong_usage, subject + ": " + text + " is not above 0"};
  return length;
}

std::optional<double> parse_opening(const Texts &texts, const Options &options) {
  if (texts.opening.empty()) return std::nullopt;
  const double opening = parse_number(texts.opening, "--opening");
  if (!(opening >= 0 && opening <= 1)) {
    throw Refusal{exit_wrong_usage, "--opening: " + texts.opening + " is not from 0 to 1"};
  }
  if (sets_opening(options)) {
    throw Refusal{exit_wrong_usage, "--opening and --set opening exclude each other"};
  }
  return opening;
}

void parse_surface_options(const Texts &texts, riis_surface_options &options) {
  check(riis_surface_options_init(&options, sizeof options));
  if (!texts.half_thickness.empty()) options.half_thickness = parse_length(texts.half_thickness, "--half-thickness");
  if (!texts.tolerance.empty()) options.tolerance = parse_number(texts.tolerance, "--tolerance");
  if (!texts.scale.empty()) options.scale = parse_number(texts.scale, "--scale");
  if (!texts.rotate.empty()) {
    const std::vector<double> turn = parse_list(texts.rotate, "--rotate", 4, "X,Y,Z,DEG");
    std::copy_n(turn.begin(), 3, options.rotation_axis);
    options.rotation_angle = turn[3];
  }
  if (!texts.translate.empty()) {
    const std::vector<double> shift = parse_list(texts.translate, "--translate", 3, "X,Y,Z");
    std::copy_n(shift.begin(), 3, options.translation);
  }
  options.zero_area = texts.skip_zero_area ? RIIS_ZERO_AREA_SKIP : RIIS_ZERO_AREA_REFUSE;
  options.flip_normals = texts.flip_normals;
  options.triangulation = position_of(texts.triangulation, triangulation_names());
  options.measure = position_of(texts.distance, distance_names);
  if (!texts.measure_tolerance.empty()) {
    if (options.measure == RIIS_MEASURE_TRIANGLES)
      throw Refusal{exit_wrong_usage, "--distance-tolerance has no effect with --distance triangles: see --tolerance"};
    options.measure_tolerance = parse_length(texts.measure_tolerance, "--distance-tolerance");
  }
}

// Derives the scale and the default half thickness from the units.
void parse_units(const Texts &texts, Options &options) {
  options.unit = unit_of(texts.unit);
  options.surface_unit = unit_of(texts.surface_unit);
  options.has_scale = !texts.scale.empty();
  options.has_half_thickness = !texts.half_thickness.empty();
  options.has_tolerance = !texts.tolerance.empty();
  const auto refuse = [](const std::string &text) { throw Refusal{exit_wrong_usage, text}; };
  const bool is_file = !options.surface.empty() || is_valve_file(options.valve);
  if (!is_file && options.surface_unit && options.surface_unit != Unit::centimetre) {
    refuse("--surface-unit: the parameters of the " + options.valve + " valve are in centimetres, not in " +
           words_of(*options.surface_unit));
  }
  if (!options.unit && options.surface_unit) refuse("--surface-unit needs --unit, the unit of the mesh");
  if (!options.unit) return;
  if (is_file && !options.surface_unit) {
    refuse("--unit needs --surface-unit, the unit of " + (options.surface.empty() ? options.valve : options.surface));
  }
  apply_units(options);
}

void check_prefix(const std::string &prefix) {
  if (is_prefix(prefix)) return;
  throw Refusal{exit_wrong_usage,
                "--prefix: '" + prefix.substr(0, 64) + "' must be 1 to 64 letters, digits, _, - and ."};
}

void parse_mark_options(const Texts &texts, riis_mark_options &options) {
  check(riis_mark_options_init(&options, sizeof options));
  if (!texts.distance_limit.empty()) options.distance_limit = parse_length(texts.distance_limit, "--distance-limit");
  if (!texts.threads.empty()) options.n_threads = parse_integer(texts.threads, "--threads");
  options.search = position_of(texts.search, search_names);
}

std::vector<Picture> pair_pictures(const Texts &texts) {
  if (texts.views.size() > texts.pictures.size()) {
    throw Refusal{exit_wrong_usage, "--view: there are more views than pictures"};
  }
  std::vector<Picture> pictures;
  for (const std::string &path : texts.pictures) pictures.push_back({path, RIIS_VTK_VIEW_OBLIQUE});
  for (std::size_t i = 0; i < texts.views.size(); ++i) pictures[i].view = position_of(texts.views[i], view_names());
  return pictures;
}

[[noreturn]] void refuse_empty(const std::string &name) {
  throw Refusal{exit_wrong_usage, name + ": the value is empty"};
}

// CLI11 would turn "--output= mesh.vtu" into "--output=mesh.vtu".
void check_equals_signs(int argc, char **argv) {
  for (int i = 1; i < argc && argv[i] != std::string("--"); ++i) {
    const std::string argument = argv[i];
    if (argument.rfind("--", 0) == 0 && argument.find('=') == argument.size() - 1) {
      refuse_empty(argument.substr(0, argument.size() - 1));
    }
  }
}

// An empty value would pass for an option that was not given.
void check_values(const std::vector<const CLI::Option *> &given) {
  for (const CLI::Option *option : given) {
    for (const std::string &value : option->results()) {
      if (value.empty()) refuse_empty(option->get_name());
    }
  }
}

// Refuses options without effect.
void check_purpose(const Options &options, const std::vector<const CLI::Option *> &given) {
  const bool exports = !options.uris.folder.empty();
  check_uris_purpose(options, given);
  if (!exports) check_series_purpose(options, given);
  check_states_purpose(options, given);
  static const std::set<std::string> of_parameters = {"--print-params", "--describe-params", "--valve", "--params",
                                                      "--set",          "--opening",         "--quiet", "--strict"};
  static const std::set<std::string> of_mesh = {"--output",       "--stats",          "--search",
                                                "--threads",      "--distance-limit", "--resistance",
                                                "--far-distance", "--distance",       "--distance-tolerance",
                                                "--allow-none",   "--steps",          "--check-leaks"};
  const bool prints = options.print_params || options.describe_params;
  const auto refuse = [](const std::string &text) { throw Refusal{exit_wrong_usage, text}; };
  for (const CLI::Option *option : given) {
    const std::string name = option->get_name();
    if (prints && of_parameters.count(name) == 0) {
      refuse(name + " has no effect with " + (options.print_params ? "--print-params" : "--describe-params"));
    }
    if (options.mesh.empty() && options.series.case_file.empty() && !exports && of_mesh.count(name) != 0)
      refuse(name + " needs a MESH");
  }
  if (!options.params_open.empty() && is_valve_file(options.valve)) {
    refuse("--params-open has no effect with --valve " + options.valve + ": the open state is in that file");
  }
  // At the default opening of most valves the file would have no effect, and nobody would see it.
  if (!options.params_open.empty() && !sets_opening(options) && options.series.cycle.empty() &&
      options.states.empty() && !exports && !options.check_crossing) {
    refuse("--params-open needs --opening, --cycle, --states, --export-uris or --check-crossing");
  }
  if (prints || exports || options.check_crossing || !options.series.case_file.empty() || !options.states.empty())
    return;
  if (options.mesh.empty()) {
    if (options.surface_output.empty() && options.pictures.empty()) refuse("nothing to do: a MESH is needed");
  } else if (options.quiet && options.output.empty() && options.surface_output.empty() && options.pictures.empty() &&
             options.stats.empty() && options.series.movie.empty() && options.series.table.empty()) {
    refuse("nothing to do: --quiet is given and no output is named");
  }
}

// Explains words that are left over on the command line. Mostly they are a value in several words for an option that takes one.
std::string hint_of(const CLI::App &app) {
  const struct {
    const char *name;
    char mark;
    int n_marks;  // in a whole value
  } forms[] = {{"--set", '=', 1}, {"--rotate", ',', 3}, {"--translate", ',', 2}};
  for (const auto &form : forms) {
    const CLI::Option *option = app.get_option(form.name);
    for (const std::string &value : option->results()) {
      if (std::count(value.begin(), value.end(), form.mark) < form.n_marks) {
        return std::string(form.name) + " takes " + option->get_type_name();
      }
    }
  }
  return "riis-mark --help lists the options";
}

std::string nearest_option(const CLI::App &app, const std::string &name) {
  NearestName nearest(name);
  for (const CLI::Option *option : app.get_options())
    for (const std::string &known : option->get_lnames()) nearest.consider(known);
  return std::string(nearest.nearest());
}

bool looks_like_option(const std::string &argument) { return argument.size() > 1 && argument[0] == '-'; }

// Returns the words that CLI11 did not understand, in the order in which they were typed, which is not CLI11's. The value of an
// unknown option is also left over, or passes for the mesh. So only the options are named then.
std::string text_of_leftovers(const CLI::App &app, int argc, char **argv) {
  std::vector<std::string> left = app.remaining();
  const bool has_options = std::any_of(left.begin(), left.end(), looks_like_option);
  std::string text;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const auto place = std::find(left.begin(), left.end(), argument);
    if (place == left.end()) continue;
    left.erase(place);
    if (looks_like_option(argument) != has_options) continue;
    if (!text.empty()) text += "; ";
    const std::string name = argument.substr(0, argument.find('='));
    text += has_options ? name + " is not an option" : argument + " is one argument too many";
    const std::string nearest = has_options && name.size() > 2 ? nearest_option(app, name.substr(2)) : "";
    if (!nearest.empty()) text += ", did you mean --" + nearest + "?";
  }
  return text;
}

}  // namespace

const std::vector<std::string> &triangulation_names() {
  static const std::vector<std::string> names = {"adapted", "fixed"};
  return names;
}

const std::vector<std::string> &view_names() {
  static const std::vector<std::string> names = {"side", "top", "oblique"};
  return names;
}

void apply_units(Options &options) {
  options.surface_options.scale = factor_between(options.surface_unit.value_or(Unit::centimetre), *options.unit);
  if (!options.has_half_thickness) options.surface_options.half_thickness = paper_half_thickness(*options.unit);
}

bool sets_opening(const Options &options) {
  return options.opening || std::any_of(options.settings.begin(), options.settings.end(),
                                        [](const std::string &setting) { return setting.rfind("opening=", 0) == 0; });
}

bool is_prefix(const std::string &name) {
  const auto is_good = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), is_good);
}

std::optional<Options> parse_command_line(int argc, char **argv) {
  Options options;
  Texts texts;
  CLI::App app(description, "riis-mark");
  app.get_formatter()->column_width(34);
  app.set_version_flag("--version", std::string("riis-mark ") + riis_version_string(), "Print the version and exit");
  app.set_help_flag("-h,--help", "Print this and exit");
  app.footer(footer);
  app.add_option("MESH", options.mesh, "The mesh, an unstructured grid: .vtu (XML) or .vtk (legacy)")
      ->type_name("FILE");
  declare_surface(app, options, texts);
  declare_placement(app, texts);
  declare_marking(app, texts);
  declare_steps(app, texts);
  declare_output(app, options, texts);
  declare_series(app, options.series, texts.series);
  declare_states(app, options, texts.state_count);
  declare_uris(app, options.uris, texts.uris);
  check_equals_signs(argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success &request) {
    std::ostringstream text;
    app.exit(request, text, text);
    write_text("-", text.str());
    return std::nullopt;
  } catch (const CLI::ExtrasError &) {
    throw Refusal{exit_wrong_usage, text_of_leftovers(app, argc, argv) + " (" + hint_of(app) + ")"};
  } catch (const CLI::ParseError &error) {
    throw Refusal{exit_wrong_usage, std::string(error.what()) + " (riis-mark --help lists the options)"};
  }
  const std::vector<const CLI::Option *> given =
      std::as_const(app).get_options([](const CLI::Option *option) { return option->count() > 0; });
  check_values(given);
  if (options.valve.empty()) options.valve = "aortic";
  if (!texts.resistance.empty()) options.resistance = parse_number(texts.resistance, "--resistance");
  if (!texts.far_distance.empty()) options.far_distance = parse_number(texts.far_distance, "--far-distance");
  options.opening = parse_opening(texts, options);
  parse_surface_options(texts, options.surface_options);
  parse_series(texts.series, options.series);
  parse_motion(texts.time, texts.period, options);
  parse_units(texts, options);
  check_prefix(options.prefix);
  parse_mark_options(texts, options.mark_options);
  options.pictures = pair_pictures(texts);
  options.n_steps = parse_steps(texts.steps);
  parse_states(texts.state_count, options);
  parse_uris(texts.uris, options.uris);
  options.check_leaks = parse_leak_check(texts.check_leaks);
  check_purpose(options, given);
  return options;
}

}  // namespace riis::program
