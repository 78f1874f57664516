// SPDX-License-Identifier: Apache-2.0
#include "program/cli/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "program/base/text.hpp"
#include "program/input/opening_law.hpp"
#include "program/input/valve_source.hpp"

namespace riis::program {
namespace {

// The largest number of openings that riis states and riis size-field accept.
constexpr std::int32_t most_states = 100001;

// A name stands for a constant of LandmarkWarp. The constant's value is the name's position in the list.
const std::vector<std::string> warp_names = {"none", "exact", "smoothed"};

// A name stands for a constant of UrisRing. The constant's value is the name's position in the list.
const std::vector<std::string> ring_names = {"face", "none"};

// Refuses numbers that are not above 0. RIIS_AUTO is a negative number, so a negative number from the user would count as
// RIIS_AUTO.
double parse_positive(const std::string &text, const std::string &subject) {
  const double number = parse_number(text, subject);
  if (!(number > 0)) refuse_usage(subject + ": " + text + " is not above 0");
  return number;
}

double parse_positive_finite(const std::string &text, const std::string &subject) {
  const double number = parse_number(text, subject);
  if (!(number > 0 && std::isfinite(number))) refuse_usage(subject + ": " + text + " is not above 0 and finite");
  return number;
}

double parse_opening(const std::string &text, const std::string &subject) {
  const double opening = parse_number(text, subject);
  if (!(opening >= 0 && opening <= 1)) refuse_usage(subject + ": " + text + " is not from 0 to 1");
  return opening;
}

// Reads a number of openings.
std::int32_t parse_count(const std::string &text, const std::string &subject) {
  const std::int32_t n = parse_integer(text, subject);
  if (n < 2 || n > most_states)
    refuse_usage(subject + ": " + text + " is not from 2 to " + std::to_string(most_states));
  return n;
}

// Returns a function that reads a number with its unit.
auto amount_of(const Quantity &quantity) {
  return [&](const std::string &text, const std::string &subject) { return parse_amount(text, subject, quantity); };
}

auto positive_amount_of(const Quantity &quantity) {
  return [&](const std::string &text, const std::string &subject) {
    Amount amount = parse_amount(text, subject, quantity);
    if (!(amount.number > 0)) refuse_usage(subject + ": " + text + " is not above 0");
    return amount;
  };
}

std::optional<Unit> parse_unit(const std::string &text, const std::string &) { return unit_of(text); }

TimeSpan parse_span(const std::string &text, const std::string &subject) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || text.find(':', colon + 1) != std::string::npos)
    refuse_usage(subject + ": '" + text + "' is not START:STOP");
  const TimeSpan span{parse_number(text.substr(0, colon), subject), parse_number(text.substr(colon + 1), subject)};
  if (!(std::abs(span.start) <= 1e30 && std::abs(span.stop) <= 1e30))
    refuse_usage(subject + ": " + text + " is not finite and at most 1e30 in magnitude");
  if (!(span.stop > span.start)) refuse_usage(subject + ": the stop of " + text + " is not after its start");
  return span;
}

// ---- Groups of options ----

void declare_settings(Command &command, const char *help, ValveOptions &options) {
  command
      .values("--set", "NAME=VALUE", help,
              [&options](const std::vector<std::string> &settings) { options.settings = settings; })
      ->allow_extra_args(false);
}

CLI::Option *declare_unit_of(Command &command, const char *name, const char *help, std::optional<Unit> &to) {
  return command.parsed(name, "m|cm|mm", help, to, parse_unit)->check(CLI::IsMember(unit_names()));
}

void declare_valve(Command &command, ValveOptions &options) {
  command.group("Valve");
  command.text("--valve", "KIND|DISEASE|FILE.json",
               "A kind of valve, such as aortic (default) or mitral; or a disease; or a file of patches (see riis help "
               "valves and riis help diseases)",
               options.valve);
  command.text("--params,--params-closed", "FILE.json",
               "Parameters of the valve; with --params-open, of its closed state", options.params);
  declare_settings(command, "Set one parameter to a number or X,Y,Z; may be repeated", options);
}

void declare_opening(Command &command, ValveOptions &options) {
  command.parsed("--opening", "X", "Opening of the valve, from 0 (closed) to 1 (open)", options.opening, parse_opening);
}

// Declares the options of a valve's shape, without its opening.
void declare_shape(Command &command, ValveOptions &options) {
  command.text("--params-open", "FILE.json", "Parameters of the open state of the valve", options.params_open);
  command.text("--warp", "FILE.json|.csv",
               "Pairs of landmarks on the valve and in the patient, which define a warp of the valve", options.warp);
  CLI::Option *const skirt = command.parsed(
      "--skirt", "L",
      "Length of the skirt from the valve to the wall, in the mesh's unit; with --wall, its largest length",
      options.skirt, parse_positive_finite);
  command
      .text("--wall", "FILE",
            "The wall at which the skirt ends: a file in a format of --surface, in the mesh's coordinates",
            options.wall)
      ->needs(skirt);
}

void declare_tolerance(Command &command, ValveOptions &options) {
  command.parsed("--tolerance", "F", "Largest deviation of triangles from the smooth valve, in half thicknesses",
                 options.surface_options.tolerance, parse_number);
}

void declare_leaflets(Command &command, CLI::Option *surface, ValveOptions &options) {
  command
      .text("--leaflets", "connected|ARRAY",
            "How --surface is divided into leaflets: connected pieces, or a cell array", options.leaflets)
      ->needs(surface);
}

CLI::Option *declare_surface_files(Command &command, ValveOptions &options) {
  CLI::Option *const surface =
      command
          .values("--surface", "FILE",
                  "Read a surface in place of a valve: .vtp, .vtu, .vtk, .stl, .obj or .ply; or a motion: .pvd or "
                  ".dat; may be repeated, one leaflet per file",
                  [&options](const std::vector<std::string> &files) { set_surface(options, files, "--surface"); })
          ->allow_extra_args(false);
  command
      .parsed("--time-step", "DT", "Time between the frames of --surface FILE.dat (default 1)", options.frame_step,
              parse_positive)
      ->needs(surface);
  return surface;
}

// Declares the options of a surface from a file, and the options of the triangles of any surface.
void declare_file(Command &command, ValveOptions &options) {
  riis_surface_options &how = options.surface_options;
  command.group("Surface");
  CLI::Option *const surface = declare_surface_files(command, options);
  for (const char *name : {"--valve", "--opening", "--params", "--params-open", "--set", "--warp"})
    surface->excludes(command.option(name));
  declare_leaflets(command, surface, options);
  command
      .value("--skip-zero-area", nullptr, "Leave out triangles of --surface that have no area",
             [&how](const std::string &) { how.zero_area = RIIS_ZERO_AREA_SKIP; })
      ->needs(surface);
  command.value("--flip-normals", nullptr, "Turn every triangle over",
                [&how](const std::string &) { how.flip_normals = 1; });
  declare_tolerance(command, options);
  command.choice("--triangulation",
                 "Choose the triangles: adapted to each opening (default), or fixed for all openings",
                 triangulation_names(), how.triangulation);
  for (const char *name : {"--tolerance", "--triangulation"}) surface->excludes(command.option(name));
  command.parsed("--time", "T", "Time to which the motion of --surface is interpolated", options.time, parse_number)
      ->needs(surface);
  command.parsed("--period", "P", "Period of the motion of --surface, or of --cycle (default none)", options.period,
                 parse_positive);
}

void declare_unit(Command &command, ValveOptions &options) {
  command.group("Placement (x -> scale * rotation * x + translation)");
  CLI::Option *const scale =
      command.parsed("--scale", "S", "Factor from the surface's unit to the mesh's unit (default 1)",
                     options.surface_options.scale, parse_number);
  declare_unit_of(command, "--unit", "Unit of the mesh; replaces --scale", options.unit)->excludes(scale);
  declare_unit_of(command, "--surface-unit", "Unit of the file that holds the surface or the patches",
                  options.surface_unit);
}

void declare_placement(Command &command, ValveOptions &options) {
  riis_surface_options &how = options.surface_options;
  declare_unit(command, options);
  command.value("--rotate", "X,Y,Z,DEG", "Rotate about an axis by an angle in degrees",
                [&how](const std::string &text) {
                  const std::vector<double> turn = parse_list(text, "--rotate", 4, "X,Y,Z,DEG");
                  std::copy_n(turn.begin(), 3, how.rotation_axis);
                  how.rotation_angle = turn[3];
                });
  command.value("--translate", "X,Y,Z", "Translate by a vector in the mesh's unit", [&how](const std::string &text) {
    const std::vector<double> shift = parse_list(text, "--translate", 3, "X,Y,Z");
    std::copy_n(shift.begin(), 3, how.translation);
  });
}

void declare_half_thickness(Command &command, ValveOptions &options) {
  command.parsed("--half-thickness", "L", "Half thickness of the band (default 0.1 times the scale)",
                 options.surface_options.half_thickness, parse_positive);
  command.parsed("--offset", "O", "Shift of the band along the normals, in half thicknesses, from -1 to 1 (default 0)",
                 options.surface_options.offset, parse_number);
}

// Declares the options of a placed surface, without the option of its half thickness.
void declare_surface_in_place(Command &command, ValveOptions &options) {
  declare_valve(command, options);
  declare_opening(command, options);
  declare_shape(command, options);
  declare_file(command, options);
  declare_placement(command, options);
}

// Declares the options of a placed surface, with the option of its half thickness.
void declare_placed_valve(Command &command, ValveOptions &options) {
  declare_surface_in_place(command, options);
  declare_half_thickness(command, options);
}

// Declares --threads. The option applies to the search for nodes and to the search for crossings.
void declare_threads(Command &command, MarkOptions &options) {
  command.value("--threads", "N", "Number of threads (default as many as the work can use)",
                [&options](const std::string &text) {
                  options.n_threads = options.mark_options.n_threads = parse_integer(text, "--threads");
                });
}

void declare_search(Command &command, MarkOptions &options) {
  command.choice("--search", "auto (default), exhaustive, neighbor, clusters or paper", search_names,
                 options.mark_options.search);
  command.parsed("--distance-limit", "L", "Write distances up to this length (default the half thickness)",
                 options.mark_options.distance_limit, parse_positive);
  declare_threads(command, options);
}

void declare_marking(Command &command, MarkOptions &options) {
  command.group("Marking");
  declare_half_thickness(command, options);
  CLI::Option *const resistance = command.parsed(
      "--resistance", "R", "Write riis_K at each node: R/eps times the delta function, with R in kg/(m s)",
      options.given_resistance, amount_of(a_resistance));
  command
      .parsed("--k-unit", "UNIT", "Unit of riis_K (default: kg/(m3 s), g/(cm3 s) or g/(mm3 s), by the mesh's unit)",
              options.chosen_K_unit, [](const std::string &text, const std::string &) { return text; })
      ->needs(resistance);
  command
      .parsed("--density", "RHO", "Density in kg/m3, by which OpenFOAM's fields of K are divided", options.density,
              positive_amount_of(a_density))
      ->needs(resistance);
  command.parsed("--far-distance", "X", "Value of riis_distance at nodes beyond the distance limit (default 1e30)",
                 options.far_distance, parse_number);
  command
      .choice("--distance",
              "Measure distances to triangles (default), or to the smooth valve by sampling or minimization",
              distance_names, options.surface_options.measure)
      ->excludes(command.option("--surface"));
  command.parsed("--distance-tolerance", "F", "Tolerance of sampling or minimization, in half thicknesses",
                 options.surface_options.measure_tolerance, parse_positive);
  declare_search(command, options);
  command
      .value("--steps", "N", "Also measure the time of N steps; each step moves the opening by 0.02 and marks again",
             [&options](const std::string &text) {
               options.n_steps = parse_integer(text, "--steps");
               if (options.n_steps < 1) refuse_usage("--steps: " + text + " is not above 0");
             })
      ->excludes(command.option("--surface"));
}

void declare_loudness(Command &command, ValveOptions &options) {
  command.flag("--quiet", "Print no table on stdout and no progress on stderr, but still print warnings",
               options.quiet);
  command.flag("--strict", "Exit with status 4 if there was a warning", options.strict);
}

// Reads a text such as 3840x2160.
PictureSize parse_size(const std::string &text, const std::string &subject) {
  const std::vector<std::string> sides = split(text, "x");
  const auto is_number = [](const std::string &side) {
    return !side.empty() && side.size() < 8 && side.find_first_not_of("0123456789") == std::string::npos;
  };
  if (sides.size() != 2 || !is_number(sides[0]) || !is_number(sides[1]))
    refuse_usage(subject + ": " + text + " is not WIDTHxHEIGHT, such as 1920x1080");
  PictureSize size;
  size.width = parse_integer(sides[0], subject);
  size.height = parse_integer(sides[1], subject);
  for (const std::int32_t side : {size.width, size.height})
    if (side < PictureSize::least || side > PictureSize::most)
      refuse_usage(subject + ": " + text + ": " + std::to_string(side) + " is not from " +
                   std::to_string(PictureSize::least) + " to " + std::to_string(PictureSize::most) + " pixels");
  return size;
}

// Reads white, black, transparent, or a colour as six hexadecimal digits.
std::array<double, 4> parse_background(const std::string &text, const std::string &subject) {
  if (text == "white") return {1, 1, 1, 1};
  if (text == "black") return {0, 0, 0, 1};
  if (text == "transparent") return {1, 1, 1, 0};
  const std::string digits = text.substr(text.rfind('#', 0) == 0 ? 1 : 0);
  if (digits.size() != 6 || digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos)
    refuse_usage(subject + ": " + text + " is not white, black, transparent, or six hexadecimal digits such as f4f1ea");
  std::array<double, 4> colour = {0, 0, 0, 1};
  for (std::size_t k = 0; k < 3; ++k) colour[k] = std::stoi(digits.substr(2 * k, 2), nullptr, 16) / 255.0;
  return colour;
}

void declare_style(Command &command, PictureStyle &style) {
  command.parsed("--picture-size", "WIDTHxHEIGHT", "Pixels of pictures and movies (default 1600x800)", style.size,
                 parse_size);
  command.parsed("--picture-background", "COLOUR",
                 "Background: white (default), black, transparent, or a colour such as f4f1ea; see riis help pictures",
                 style.background, parse_background);
  command.choice("--picture-captions", "Captions of pictures: all (default), scale (only the scale bar) or none",
                 caption_names, style.captions, "WHICH");
  command.choice("--picture-panels", "both (default), valve or marks", panel_names, style.panels, "WHICH");
}

// CLI11 gives the pictures to the program before the views, because --view is declared after --picture. The number of pictures is
// therefore known when the views are read.
void declare_pictures(Command &command, MarkOptions &options) {
  CLI::Option *const pictures =
      command
          .values("--picture", "OUT.png", "Draw the surface and the marked cells; may be repeated",
                  [&options](const std::vector<std::string> &paths) {
                    for (const std::string &path : paths) options.pictures.push_back({path, RIIS_VTK_VIEW_OBLIQUE});
                  })
          ->allow_extra_args(false);
  command
      .values("--view", "VIEW",
              "View of --picture: side, top, oblique (default) or three, in the mesh's axes; or valve-side, ... in the "
              "valve's axes",
              [&options](const std::vector<std::string> &views) {
                if (views.size() > options.pictures.size()) refuse_usage("--view: there are more views than pictures");
                for (std::size_t i = 0; i < views.size(); ++i)
                  options.pictures[i].view = position_of(views[i], view_names);
              })
      ->allow_extra_args(false)
      ->check(CLI::IsMember(view_names))
      ->needs(pictures);
  declare_style(command, options.style);
}

void declare_stats(Command &command, MarkOptions &options) {
  command.text("--stats", "FILE.json|-", "Write counts, and times in seconds, as JSON; - is stdout", options.stats);
}

void declare_cycle(Command &command, std::string &cycle, std::int32_t &interpolation) {
  CLI::Option *const file =
      command.text("--cycle", "FILE.csv", "File with the times and openings of the valve in two columns", cycle);
  command
      .choice("--interpolation", "Interpolation between the times of the cycle: linear (default) or cubic",
              interpolation_names(), interpolation)
      ->needs(file);
}

CLI::Option *declare_case(Command &command, SeriesOptions &series) {
  return command.text("--case", "FILE.json", "File with valves, placements, cycles and times (riis help cases)",
                      series.case_file);
}

// Excludes the options whose values come from the case file.
void exclude_by_case(const Command &command, CLI::Option *all_of_it) {
  for (const char *name :
       {"--surface", "--leaflets",      "--valve",         "--opening",        "--params",         "--params-open",
        "--set",     "--tolerance",     "--triangulation", "--skip-zero-area", "--flip-normals",   "--scale",
        "--unit",    "--surface-unit",  "--rotate",        "--translate",      "--half-thickness", "--cycle",
        "--period",  "--interpolation", "--prefix",        "--time",           "--skirt",          "--wall",
        "--warp",    "--time-step"})
    if (command.knows(name)) command.option(name)->excludes(all_of_it);
}

void declare_series(Command &command, MarkOptions &options) {
  SeriesOptions &series = options.series;
  command.group("Series in time, and several valves");
  CLI::Option *const times =
      command.parsed("--times", "START:STOP:STEP|T,T,...", "Mark at each of these times; --output is then a .pvd file",
                     series.times, parse_times);
  declare_cycle(command, series.cycle, series.interpolation);
  CLI::Option *const all_of_it = declare_case(command, series);
  command.flag("--all-cells", "At each time, write the whole mesh, not only the cells near the moving valve",
               series.all_cells);
  command.text("--series-table", "OUT.csv", "Write a table of each step's time, opening, marked nodes and speed",
               series.table);
  CLI::Option *const movie =
      command.text("--movie", "OUT.mp4|OUT.gif", "Make a movie of all times, with ffmpeg", series.movie);
  command
      .parsed("--frame-rate", "N", "Frames of the movie per second (default 10)", series.frame_rate,
              parse_positive_finite)
      ->needs(movie);
  command
      .choice("--movie-view", "View of the movie, as for --view (default oblique)", view_names, series.movie_view,
              "VIEW")
      ->needs(movie);
  exclude_by_case(command, all_of_it);
  command.option("--opening")->excludes(times);
  command.option("--time")->excludes(times);
}

void declare_cells_where(Command &command, ValveOptions &options) {
  command.text("--cells-where", "NAME=VALUES",
               "Use only the cells whose value in the array NAME is one of VALUES, as in gmsh:physical=lumen; see riis "
               "help mesh",
               options.cells_where);
}

void declare_mesh(Command &command, MarkOptions &options) {
  command.group("Mesh");
  command.text("MESH", "FILE",
               "The mesh: .vtu, .pvtu, .vtk, .vti, .vtr, .vts, .vtm, .msh, .xdmf, .exo, or a case of OpenFOAM",
               options.mesh);
  declare_cells_where(command, options);
}

void declare_allow_none(Command &command, MarkOptions &options) {
  command.flag("--allow-none", "Exit with status 0 and without a warning if no node is marked", options.allow_none);
}

}  // namespace

void declare_mark(Command command, MarkOptions &options) {
  declare_mesh(command, options);
  command.flag("--cells", "Mark the centres of cells, not the nodes; the output then has cell arrays",
               options.at_cells);
  declare_surface_in_place(command, options);
  declare_marking(command, options);
  command.group("Output");
  CLI::Option *const output = command.text("--output", "OUT",
                                           "Write the marked mesh: .vtu or .xdmf; .pvtu, .vti or .vtr if MESH has this "
                                           "format; with --cells also CASE/TIME of OpenFOAM",
                                           options.output);
  command
      .text("--prefix", "NAME", "Begin the names of the arrays with NAME, as in NAME_marked (default riis)",
            options.prefix)
      ->needs(output);
  command.flag("--replace", "Allow new arrays to replace arrays of the mesh with the same names", options.replace)
      ->needs(output);
  declare_allow_none(command, options);
  command.text("--surface-output", "OUT.vtp", "Write the placed triangles", options.surface_output);
  declare_pictures(command, options);
  command.text("--picture-velocity", "NAME",
               "Draw the speed from this array of velocities, such as U, in place of the marked cells",
               options.style.velocity);
  declare_stats(command, options);
  declare_loudness(command, options);
  declare_series(command, options);
}

void declare_surface(Command command, MarkOptions &options) {
  options.surface_output_option = "--output";
  declare_placed_valve(command, options);
  command.group("Output");
  command.text("--output", "OUT.vtp", "Write the placed triangles", options.surface_output);
  declare_pictures(command, options);
  declare_loudness(command, options);
}

void declare_crossings(Command command, MarkOptions &options) {
  options.check_crossing = true;
  options.needs_mesh = false;
  declare_placed_valve(command, options);
  exclude_by_case(command, declare_case(command, options.series));
  declare_threads(command, options);
  declare_stats(command, options);
  declare_loudness(command, options);
}

void declare_leaks(Command command, MarkOptions &options) {
  declare_mesh(command, options);
  command.flag("--cells", "Use the centres of cells in place of the nodes, as in riis mark --cells", options.at_cells);
  command
      .values("--between", "X,Y,Z X,Y,Z", "Report whether unmarked nodes connect these two points, and where",
              [&options](const std::vector<std::string> &ends) {
                options.check_leaks = LeakCheck{{}, "--between"};
                for (const std::string &end : ends)
                  for (const double x : parse_list(end, "--between", 3, "X,Y,Z"))
                    options.check_leaks->points.push_back(x);
              })
      ->expected(2)
      ->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  options.measures = true;
  command
      .flag("--first-passage", "Also report the first opening at which unmarked nodes connect the points",
            options.first_passage)
      ->needs(command.option("--between"));
  command.flag("--demand-sealed",
               "Exit with status 4 if the valve leaks, or if the command cannot tell whether it leaks",
               options.demand_sealed);
  CLI::Option *const resistance =
      command.parsed("--resistance", "R", "Resistance of the valve in kg/(m s), to report the ideal leak; needs --drop",
                     options.given_resistance, positive_amount_of(a_resistance));
  CLI::Option *const drop = command.parsed(
      "--drop", "DP", "Pressure drop across the closed valve in Pa, to report the ideal leak; needs --resistance",
      options.given_drop, amount_of(a_pressure));
  drop->needs(resistance);
  resistance->needs(drop);
  declare_surface_in_place(command, options);
  command.group("Marking");
  declare_half_thickness(command, options);
  declare_search(command, options);
  exclude_by_case(command, declare_case(command, options.series));
  command.group("Output");
  declare_allow_none(command, options);
  declare_stats(command, options);
  declare_loudness(command, options);
}

void declare_size_field(Command command, SizeFieldOptions &options) {
  command
      .text("OUT", "OUT.dat|-", "The grid of edge lengths, for gmsh's field \"Structured\"; - is stdout", options.field)
      ->required();
  command.parsed("--band-edge", "F", "Edge length in the band, in half thicknesses (default 0.95)", options.band_edge,
                 parse_positive_finite);
  command.parsed("--growth", "F", "Growth of the edge length per unit of distance from the band (default 0.3)",
                 options.growth, parse_positive_finite);
  command.parsed("--largest-edge", "L", "Largest edge length, in the mesh's unit (default 4 half thicknesses)",
                 options.largest_edge, parse_positive_finite);
  command.parsed("--spacing", "L", "Spacing of the grid, in the mesh's unit (default 0.5 half thicknesses)",
                 options.spacing, parse_positive_finite);
  command.parsed("--count", "N", "Number of openings (default 41)", options.n_openings, parse_count);
  declare_threads(command, options);
  declare_loudness(command, options);
  declare_placed_valve(command, options);
  SeriesOptions &series = options.series;
  command.group("Motion in time, and several valves");
  CLI::Option *const times =
      command.parsed("--times", "START:STOP:STEP|T,T,...", "Use the times of a motion in place of openings",
                     series.times, parse_times);
  declare_cycle(command, series.cycle, series.interpolation);
  CLI::Option *const all_of_it = declare_case(command, series);
  exclude_by_case(command, all_of_it);
  command.option("--count")->excludes(all_of_it);
  for (const char *name : {"--opening", "--time", "--count"}) command.option(name)->excludes(times);
}

void declare_states(Command command, StatesOptions &options) {
  command
      .text("OUT", "OUT.csv|-", "Write the table of free edges, leaflet areas and orifices; - is stdout",
            options.output)
      ->required();
  command.parsed("--count", "N", "Number of openings (default 101)", options.n_states, parse_count);
  command.flag("--coaptation", "Also write the area and the length of the contacts between leaflets",
               options.has_contacts);
  declare_loudness(command, options);
  declare_valve(command, options);
  declare_shape(command, options);
  declare_tolerance(command, options);
  CLI::Option *const surface = declare_surface_files(command, options);
  for (const char *name : {"--valve", "--params", "--params-open", "--set", "--warp", "--tolerance", "--count"})
    surface->excludes(command.option(name));
  command.option("--wall")->remove_needs(command.option("--skirt"));  // without a skirt, the wall bounds the orifice
  declare_leaflets(command, surface, options);
  declare_unit(command, options);
  declare_half_thickness(command, options);
}

void declare_from_area(Command command, AreaOptions &options) {
  CLI::Option *const area = command.parsed(
      "--area", "A", "The area of the orifice, in the mesh's unit squared or with a unit, such as '2.5 cm2'",
      options.given_area, amount_of(an_area));
  CLI::Option *const areas = command.text(
      "--areas", "FILE.csv", "File with the columns time and area, from which the command makes a cycle of openings",
      options.areas);
  area->excludes(areas);
  command
      .parsed("--area-unit", "UNIT", "Unit of the areas in --areas, such as cm2 (default the mesh's unit squared)",
              options.area_unit, [](const std::string &text, const std::string &) { return text; })
      ->needs(areas);
  command.flag("--effective", "The given areas are effective areas, without the part that the band closes",
               options.is_effective);
  command
      .text("--solve", "opening|scale|NAME", "Find the opening (default), the scale, or the parameter NAME",
            options.solve)
      ->excludes(areas);
  command.parsed("--from", "X", "Least opening or size to consider", options.from, parse_number);
  command.parsed("--to", "X", "Largest opening or size to consider", options.to, parse_number);
  command
      .text("--output", "OUT.csv|-", "Write the cycle to this file, for --cycle of other commands; - is stdout",
            options.output)
      ->needs(areas);
  command.parsed("--period", "P", "Period of --areas (default none)", options.period, parse_positive)->needs(areas);
  declare_loudness(command, options);
  declare_valve(command, options);
  declare_opening(command, options);
  declare_shape(command, options);
  declare_tolerance(command, options);
  command.choice("--triangulation",
                 "Choose the triangles: adapted to each opening (default), or fixed for all openings",
                 triangulation_names(), options.surface_options.triangulation);
  declare_unit(command, options);
  declare_half_thickness(command, options);
}

void declare_export(Command command, ExportOptions &options) {
  command.text("FOLDER", "FOLDER", "A new or empty folder for the files of svMultiPhysics", options.folder)->required();
  command.text("MESH", "FILE", "The mesh of the solver's run; with it, the command predicts what the solver will do",
               options.mesh);
  declare_cells_where(command, options);
  command.option("--cells-where")->needs(command.option("MESH"));
  command
      .parsed("--time-step", "DT", "Time step of the solver; the motion has one frame for each step", options.time_step,
              parse_positive_finite)
      ->required();
  command
      .parsed("--resistance", "R", "Resistance of the valve in kg/(m s), for the solver's input",
              options.given_resistance, amount_of(a_resistance))
      ->required();
  command.parsed("--opening-seconds", "T", "Time in which the valve opens from 0 to 1, by a smooth ramp",
                 options.opening_duration, parse_positive_finite);
  command.parsed("--closing-seconds", "T", "Time in which the valve closes from 1 to 0", options.closing_duration,
                 parse_positive_finite);
  declare_cycle(command, options.cycle, options.interpolation);
  command.parsed("--period", "P", "Period of --cycle (default none)", options.period, parse_positive);
  command.parsed("--opening-span", "START:STOP", "Times of --cycle at which the valve starts and stops opening",
                 options.opening_span, parse_span);
  command.parsed("--closing-span", "START:STOP", "Times of --cycle at which the valve starts and stops closing",
                 options.closing_span, parse_span);
  for (const char *name : {"--period", "--opening-span", "--closing-span"})
    command.option(name)->needs(command.option("--cycle"));
  for (const char *name : {"--opening-seconds", "--closing-seconds"})
    command.option(name)->excludes(command.option("--cycle"));
  command.parsed("--largest-edge", "L", "Cut triangles until no edge is longer than L in any frame",
                 options.largest_edge, parse_positive_finite);
  command.text("--name", "NAME", "Name of the valve in the solver and in its files (default the name of FOLDER)",
               options.name);
  command
      .text("--starts", "closed|open",
            "State of the valve at the solver's first step (default closed, or with --cycle the state at time 0)",
            options.starts)
      ->check(CLI::IsMember(std::vector<std::string>{"closed", "open"}));
  command.choice("--ring", "Export the ring of a bileaflet valve as one more face (default), or leave it out",
                 ring_names, options.ring);
  command.parsed("--density", "RHO", "Density of the fluid in kg/m3, used with MESH (default 1060, for blood)",
                 options.given_density, positive_amount_of(a_density));
  command.parsed("--viscosity", "MU", "Viscosity of the fluid in Pa s, used with MESH (default 0.004, for blood)",
                 options.given_viscosity, positive_amount_of(a_viscosity));
  for (const char *name : {"--density", "--viscosity"}) command.option(name)->needs(command.option("MESH"));
  declare_loudness(command, options);
  declare_valve(command, options);
  declare_shape(command, options);
  declare_tolerance(command, options);
  declare_placement(command, options);
  declare_half_thickness(command, options);
}

void declare_place(Command command, PlaceOptions &options) {
  command
      .text("LANDMARKS", "FILE.json|.csv|.fcsv", "The landmarks: JSON, CSV, or 3D Slicer's .mrk.json or .fcsv",
            options.landmarks)
      ->required();
  command.text("--output", "OUT.json",
               "Write the placed valve to this file, for --valve of other commands; - is stdout", options.output);
  command.text("--foam", "OUT", "Write the placed valve for OpenFOAM, in metres", options.foam_output);
  command
      .parsed("--skirt", "L", "Largest length of the skirt to the wall in OpenFOAM, in the mesh's unit (default 6 mm)",
              options.skirt, parse_positive_finite)
      ->needs(command.option("--foam"));
  command.text("--c", "OUT", "The placed valve as lines of C", options.c_output);
  command.text("--fortran", "OUT", "The placed valve as lines of Fortran", options.fortran_output);
  declare_loudness(command, options);
  command.group("Landmarks");
  command.text("--mesh", "MESH", "Refuse landmarks that are far from this mesh", options.mesh);
  declare_cells_where(command, options);
  command.option("--cells-where")->needs(command.option("--mesh"));
  declare_unit_of(command, "--unit", "Unit of the mesh (default the unit of the landmarks)", options.unit);
  command.text("--axes", "LPS|RAS", "Axes of the mesh (default the axes of the landmarks)", options.axes)
      ->check(CLI::IsMember(std::vector<std::string>{"LPS", "RAS"}));
  command.choice("--warp", "Warp the valve to the landmarks: none (default), exact, or smoothed by their noise",
                 warp_names, options.warp_choice);
  command.value("--noise", "L", "Noise of the landmarks: the standard deviation of each coordinate (default 0.3 mm)",
                [&options](const std::string &text) {
                  options.noise = parse_number(text, "--noise");
                  if (!(*options.noise >= 0)) refuse_usage("--noise: " + text + " is below 0");
                });
  command.value("--flow", "X,Y,Z", "Direction of flow through the valve, in the mesh's axes",
                [&options](const std::string &text) { options.flow = parse_list(text, "--flow", 3, "X,Y,Z"); });
  command.group("Valve");
  command.text("--valve", "KIND", "Kind of valve, such as aortic or mitral (default the kind in the file)",
               options.valve);
  command.text("--params", "FILE.json", "Parameters of the valve before it is fitted to the landmarks", options.params);
  declare_settings(command, "Set one parameter, in cm, and keep it during the fit; may be repeated", options);
}

void declare_patient(Command command, PatientOptions &options) {
  command
      .text("WALL", "FILE", "The wall: a closed surface around the blood (.stl, .vtp, ...), or a volume mesh",
            options.wall)
      ->required();
  command
      .text("LANDMARKS", "FILE.json|.csv|.fcsv", "The landmarks of the valve, as riis place reads them",
            options.landmarks)
      ->required();
  command
      .text("--output", "FOLDER", "A new or empty folder for the mesh, the valve, pictures and reports", options.folder)
      ->required();
  command
      .text("--solver", "NAME", "Also write a case: openfoam, svmultiphysics, fenicsx or none (default)",
            options.solver)
      ->check(CLI::IsMember(solver_names));
  command.flag("--replace",
               "Replace the files that an earlier riis patient wrote to FOLDER, and remove computed results",
               options.replace);
  declare_loudness(command, options);
  command.group("Landmarks and wall (points, and lengths without a unit, are in the unit of WALL)");
  declare_unit_of(command, "--wall-unit", "Unit of WALL (default the unit that puts the landmarks at the wall)",
                  options.wall_unit);
  command.text("--axes", "LPS|RAS", "Axes of WALL (default the axes that put the landmarks at the wall)", options.axes)
      ->check(CLI::IsMember(std::vector<std::string>{"LPS", "RAS"}));
  declare_unit_of(command, "--unit",
                  "Unit of the files in FOLDER (default the solver's unit, or WALL's unit without a solver)",
                  options.unit);
  command.choice("--warp", "Warp the valve to the landmarks: none, exact, or smoothed by their noise (default)",
                 warp_names, options.warp_choice);
  command.parsed("--noise", "L", "Noise of the landmarks: the standard deviation of each coordinate (default 0.3 mm)",
                 options.noise, amount_of(a_length));
  command.value("--flow", "X,Y,Z", "Direction of flow through the valve, in the axes of WALL",
                [&options](const std::string &text) { options.flow = parse_list(text, "--flow", 3, "X,Y,Z"); });
  command.value("--inlet", "X,Y,Z",
                "A point near the flat end through which blood enters (default found from the valve)",
                [&options](const std::string &text) { options.inlet = parse_list(text, "--inlet", 3, "X,Y,Z"); });
  command
      .values("--outlet", "X,Y,Z",
              "A point near an end through which blood leaves; may be repeated (default all other ends)",
              [&options](const std::vector<std::string> &texts) {
                for (const std::string &text : texts)
                  options.outlets.push_back(parse_list(text, "--outlet", 3, "X,Y,Z"));
              })
      ->allow_extra_args(false);
  command.group("Valve");
  command.text("--valve", "KIND|DISEASE",
               "Kind of valve, such as coapting or mitral, or a disease (default the kind in the file of landmarks)",
               options.valve);
  command.text("--params", "FILE.json", "Parameters of the valve before it is fitted to the landmarks", options.params);
  declare_settings(command, "Set one parameter, in cm, and keep it during the fit; may be repeated", options);
  command.parsed("--skirt", "L", "The longest acceptable skirt from the valve to the wall (default 6 mm)",
                 options.given_skirt, positive_amount_of(a_length));
  command.group("Mesh and flow");
  command.parsed("--half-thickness", "L", "Half thickness of the band (default 1 mm, and 1.5 mm for a mitral valve)",
                 options.given_half_thickness, positive_amount_of(a_length));
  command.parsed("--band-edge", "F",
                 "Edge length in the band, in half thicknesses (default 0.95, or 0.55 for svmultiphysics)",
                 options.band_edge, parse_positive_finite);
  command.parsed("--largest-edge", "L", "Largest edge length of the mesh (default 3 half thicknesses)",
                 options.given_largest_edge, positive_amount_of(a_length));
  command.parsed("--resistance", "R", "Resistance of the valve in kg/(m s) (default 1e4)", options.given_resistance,
                 positive_amount_of(a_resistance));
  command.parsed("--hold", "X", "With --solver openfoam: hold the valve at an opening below 1", options.hold,
                 parse_opening);
  command.parsed("--heart-rate", "N", "With a solver: heart rate in beats a minute, 40 to 180 (default 75)",
                 options.heart_rate, parse_positive_finite);
}

void declare_params(Command command, ParamsOptions &options) {
  command.flag("--describe", "Print a table with units, ranges and descriptions, not JSON", options.describe);
  declare_loudness(command, options);
  declare_valve(command, options);
  declare_opening(command, options);
}

}  // namespace riis::program
