// SPDX-License-Identifier: Apache-2.0
// Checks that the options of a command fit together. See command_line.hpp.
#include "program/cli/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>

#include "program/base/text.hpp"
#include "program/input/mesh_reading.hpp"
#include "program/input/valve_file.hpp"
#include "program/input/valve_source.hpp"

namespace riis::program {
namespace {

bool has_set_opening(const ValveOptions &options) {
  return std::any_of(options.settings.begin(), options.settings.end(),
                     [](const std::string &setting) { return setting.rfind("opening=", 0) == 0; });
}

void check_set_opening(const ValveOptions &options, const std::string &reason) {
  if (has_set_opening(options)) refuse_usage("--set opening " + reason);
}

void check_opening(const ValveOptions &options) {
  if (options.opening && has_set_opening(options)) refuse_usage("--opening and --set opening exclude each other");
}

void check_surface_files(const Command &command, const ValveOptions &options) {
  if (options.surface_files.size() > 1 && !options.leaflets.empty())
    refuse_usage("--leaflets has no effect with several files, because each file is one leaflet");
  if (command.has("--time-step") && !is_motion(options)) refuse_usage("--time-step needs a motion, --surface FILE.dat");
}

// Derives the scale and the default half thickness from the units.
void finish_units(ValveOptions &options) {
  const bool is_file = !options.surface.empty() || is_valve_file(options.valve);
  if (!is_file && options.surface_unit && options.surface_unit != Unit::centimetre)
    refuse_usage("--surface-unit: the parameters of the " + options.valve + " valve are in centimetres, not in " +
                 words_of(*options.surface_unit));
  if (!options.unit && options.surface_unit) refuse_usage("--surface-unit needs --unit, the unit of the mesh");
  if (!options.unit) return;
  if (is_file && !options.surface_unit)
    refuse_usage("--unit needs --surface-unit, the unit of " +
                 (options.surface.empty() ? options.valve : options.surface));
  apply_units(options);
}

// Refuses a motion without a time, and a time without a motion. Also refuses a period without a motion or a cycle.
void check_motion(const Command &command, const MarkOptions &options) {
  check_surface_files(command, options);
  const bool moves = is_motion(options);
  if (moves && !options.time && options.series.times.empty())
    refuse_usage("--surface " + options.surface + " is a motion: it needs --time T");
  if (!moves && options.time)
    refuse_usage("--time has no effect with --surface " + options.surface + ": a motion is a .pvd or .dat file");
  if (command.has("--period") && !moves && options.series.cycle.empty())
    refuse_usage("--period needs a motion that repeats: --surface FILE.pvd, --surface FILE.dat or --cycle");
}

void check_open_state(const ValveOptions &options) {
  if (!options.params_open.empty() && is_valve_file(options.valve))
    refuse_usage("--params-open has no effect with --valve " + options.valve + ": the open state is in that file");
}

// Refuses the parameters of an open state if the user gave no opening. Without an opening the valve stays closed, so these
// parameters would have no effect, and the user would not notice.
void check_open_state_is_met(const MarkOptions &options) {
  if (!options.params_open.empty() && !sets_opening(options) && options.series.cycle.empty())
    refuse_usage("--params-open needs --opening or --cycle: without them the valve stays closed");
}

void check_series(const Command &command, const MarkOptions &options) {
  const SeriesOptions &series = options.series;
  if (!series.case_file.empty()) return;
  if (series.times.empty()) {
    for (const char *name : {"--cycle", "--movie", "--series-table", "--all-cells"})
      if (command.has(name)) refuse_usage(std::string(name) + " needs --times");
    return;
  }
  if (!options.surface.empty()) {
    if (!series.cycle.empty()) refuse_usage("--cycle has no effect with --surface");
    if (!is_motion(options))
      refuse_usage("--times has no effect with --surface " + options.surface + ": a motion is a .pvd or .dat file");
    return;
  }
  if (series.cycle.empty()) refuse_usage("--times needs --cycle, a file with the valve's openings in time");
  check_set_opening(options, "has no effect with --times: see --cycle");
}

void check_valve(const Command &command, ValveOptions &options) {
  options.has_scale = command.has("--scale");
  options.has_half_thickness = command.has("--half-thickness");
  options.has_tolerance = command.has("--tolerance");
  use_named_valve(options);
  check_opening(options);
  check_open_state(options);
}

void finish_valve(const Command &command, ValveOptions &options) {
  check_valve(command, options);
  finish_units(options);
}

// Completes the options of a surface in a mesh. An option that the command does not have keeps its default. `sweeps_openings`
// says whether the command itself opens the valve.
void finish_surface_in_place(const Command &command, MarkOptions &options, bool sweeps_openings = false) {
  check_valve(command, options);
  check_series(command, options);
  check_motion(command, options);
  if (!sweeps_openings) check_open_state_is_met(options);
  finish_units(options);
}

void check_distance(const Command &command, const MarkOptions &options) {
  if (command.has("--distance-tolerance") && options.surface_options.measure == RIIS_MEASURE_TRIANGLES)
    refuse_usage(
        "--distance-tolerance has no effect with --distance triangles: --tolerance sets the error of triangles");
}

// Refuses options for the looks of pictures if there is neither a picture nor a movie. Also refuses options that do not fit a
// movie, and options that need a mesh if there is none.
void check_style(const Command &command, const MarkOptions &options) {
  const std::string &movie = options.series.movie;
  const PictureStyle &style = options.style;
  for (const char *name :
       {"--picture-size", "--picture-background", "--picture-captions", "--picture-panels", "--picture-velocity"})
    if (command.has(name) && options.pictures.empty() && movie.empty())
      refuse_usage(std::string(name) + " has no effect without --picture" +
                   (command.knows("--movie") ? " or --movie" : ""));
  if (!movie.empty() && style.background[3] == 0) refuse_usage("--picture-background: a movie cannot be transparent");
  const bool is_odd = style.size && (style.size->width % 2 != 0 || style.size->height % 2 != 0);
  if (is_odd && has_ending(movie, ".mp4"))
    refuse_usage("--picture-size: both numbers must be even for the movie " + movie);
  if (style.panels == RIIS_VTK_PANELS_MARKS && options.mesh.empty() && options.series.case_file.empty())
    refuse_usage("--picture-panels marks: there is no mesh, so nothing is marked");
  if (style.velocity.empty()) return;
  if (!movie.empty())
    refuse_usage("--picture-velocity: " + style.velocity + " is read at one time, but a movie shows many times");
  if (style.panels == RIIS_VTK_PANELS_VALVE)
    refuse_usage("--picture-velocity has no effect with --picture-panels valve, because this panel shows no flow");
}

bool has_output(const MarkOptions &options) {
  return !options.output.empty() || !options.surface_output.empty() || !options.pictures.empty() ||
         !options.stats.empty() || !options.series.movie.empty() || !options.series.table.empty();
}

// Paths with blanks are refused, because svMultiPhysics removes every blank from a path.
void check_folder_name(const std::string &folder) {
  const auto is_blank = [](unsigned char c) { return c <= ' ' || c == 127; };
  if (std::any_of(folder.begin(), folder.end(), is_blank))
    refuse_usage("FOLDER: '" + folder + "' has a blank, but svMultiPhysics cannot read a path with blanks");
}

// The sizes of a kind of valve are in centimetres, so a valve's scale determines the unit of the mesh.
void check_solver_scale(const ExportOptions &options) {
  if (options.unit || !options.has_scale || is_valve_file(options.valve)) return;
  const auto unit = unit_reached(Unit::centimetre, options.surface_options.scale);
  if (!unit || *unit == Unit::centimetre) return;
  refuse_usage("--scale: " + shortest(options.surface_options.scale) + " makes lengths in " + words_of(*unit) +
               ", and svMultiPhysics needs grams and centimetres: write --unit " + name_of(*unit) +
               " in place of --scale; riis export then converts the lengths");
}

// svMultiPhysics gets numbers in grams, centimetres and seconds. Without --unit, numbers count as numbers in the solver's units,
// so nothing is converted.
void finish_solver_units(ExportOptions &options) {
  check_solver_scale(options);
  const auto in_solver_units = [&](const std::optional<Amount> &given, const Quantity &quantity, double usual) {
    if (!given) return usual * factor_from_si(quantity, Unit::centimetre);
    if (given->number < 0) refuse_usage(given->subject + ": " + given->text + " is below 0");
    const bool is_si = given->has_unit || options.unit;
    return in_mesh_units(*given, quantity, is_si ? std::optional(Unit::centimetre) : std::nullopt);
  };
  if (options.unit) options.to_solver = factor_between(*options.unit, Unit::centimetre);
  constexpr double blood_density = 1060, blood_viscosity = 0.004;
  options.resistance = in_solver_units(options.given_resistance, a_resistance, 0);
  options.density = in_solver_units(options.given_density, a_density, blood_density);
  options.viscosity = in_solver_units(options.given_viscosity, a_viscosity, blood_viscosity);
}

// Converts the area into the mesh's unit. The parameters of a kind of valve are in centimetres. If such a valve is not scaled,
// its mesh is in centimetres, too.
void finish_areas(AreaOptions &options) {
  const bool is_in_centimetres = !options.has_scale && !is_valve_file(options.valve);
  const std::optional<Unit> unit = options.unit        ? options.unit
                                   : is_in_centimetres ? std::optional(Unit::centimetre)
                                                       : std::nullopt;
  if (options.given_area) {
    const Amount &given = *options.given_area;
    options.area = given.has_unit ? in_mesh_units(given, an_area, unit) : given.number;
    if (!(*options.area >= 0 && std::isfinite(*options.area)))
      refuse_usage(given.subject + ": " + given.text + " is not a finite area of at least 0");
  }
  if (!options.area_unit) return;
  const double si = parse_unit_of(*options.area_unit, "--area-unit", an_area);
  if (!unit) refuse_usage("--area-unit needs the unit of the mesh: write --unit m, cm or mm");
  options.area_factor = si * factor_from_si(an_area, *unit);
}

}  // namespace

MarkOptions finish_mark(const Command &command, MarkOptions options) {
  const bool has_case = !options.series.case_file.empty();
  finish_surface_in_place(command, options);
  check_distance(command, options);
  if (!is_prefix(options.prefix))
    refuse_usage("--prefix: '" + options.prefix.substr(0, 64) +
                 "' must have 1 to 64 characters: letters, digits, _, - and .");
  if (options.at_cells) {
    if (!options.pictures.empty()) refuse_usage("--cells: --picture shows marks of nodes");
    if (!options.series.movie.empty()) refuse_usage("--cells: --movie shows marks of nodes");
    if (options.n_steps > 0) refuse_usage("--cells: --steps marks nodes, not centres");
    options.series.all_cells = true;  // files of centres always have the whole mesh
  }
  if (options.n_steps > 0 && (has_case || !options.series.times.empty()))
    refuse_usage("--steps has no effect with --times or --case, because these options already move the valves");
  if (has_case) return options;
  apply_amounts(options);
  if (options.mesh.empty()) refuse_usage("nothing to do: a MESH is needed");
  check_style(command, options);
  if (options.quiet && !has_output(options))
    refuse_usage("nothing to do: --quiet is given, and no option names an output");
  return options;
}

MarkOptions finish_surface(const Command &command, MarkOptions options) {
  finish_surface_in_place(command, options);
  check_style(command, options);
  if (!has_output(options)) refuse_usage("nothing to do: --output or --picture is needed");
  return options;
}

MarkOptions finish_crossings(const Command &command, MarkOptions options) {
  finish_surface_in_place(command, options, true);
  return options;
}

MarkOptions finish_leaks(const Command &command, MarkOptions options) {
  if (options.mesh.empty() && options.series.case_file.empty()) refuse_usage("MESH is required");
  finish_surface_in_place(command, options);
  if (options.series.case_file.empty()) apply_amounts(options);
  return options;
}

SizeFieldOptions finish_size_field(const Command &command, SizeFieldOptions options) {
  finish_surface_in_place(command, options, true);
  if (command.has("--count") && (sets_opening(options) || !options.surface.empty()))
    refuse_usage("--count has no effect, because the command uses only one opening");
  return options;
}

StatesOptions finish_states(const Command &command, StatesOptions options) {
  if (command.has("--wall") && options.surface.empty() && !options.skirt)
    refuse_usage("--wall needs --skirt or --surface");
  check_surface_files(command, options);
  check_set_opening(options, "has no effect, because the table lists all openings");
  finish_valve(command, options);
  return options;
}

AreaOptions finish_from_area(const Command &command, AreaOptions options) {
  if (!options.given_area && options.areas.empty()) refuse_usage("nothing to do: --area or --areas is needed");
  if (!options.areas.empty() && options.output.empty())
    refuse_usage("--areas needs --output, the file to which the cycle is written");
  if (options.solve == "opening" && sets_opening(options))
    refuse_usage(
        "a given opening has no effect, because the command finds the opening; with --solve scale or --solve NAME it "
        "finds "
        "a size");
  finish_valve(command, options);
  finish_areas(options);
  return options;
}

ExportOptions finish_export(const Command &command, ExportOptions options) {
  check_folder_name(options.folder);
  // Two dashes in a row would end the comment in the XML file.
  if (command.has("--name") && (!is_prefix(options.name) || options.name.find("--") != std::string::npos))
    refuse_usage("--name: '" + options.name.substr(0, 64) +
                 "' must have 1 to 64 characters: letters, digits, _, . and -, without two - in a row");
  if (command.has("--ring") && options.valve != "bileaflet")
    refuse_usage("--ring has no effect: only a bileaflet valve has a ring");
  check_set_opening(options, "has no effect, because the export contains all openings");
  finish_valve(command, options);
  if (options.cycle.empty() && (!options.opening_duration || !options.closing_duration))
    refuse_usage("riis export needs --opening-seconds and --closing-seconds, or --cycle");
  finish_solver_units(options);
  return options;
}

ParamsOptions finish_params(const Command &command, ParamsOptions options) {
  finish_valve(command, options);
  return options;
}

PlaceOptions finish_place(const Command &command, PlaceOptions options) {
  options.has_valve = command.has("--valve");
  if (options.has_valve && is_valve_file(options.valve))
    refuse_usage("--valve: " + options.valve + " is a file; landmarks place a kind of valve");
  use_named_valve(options);
  if (options.output != "-" && !options.output.empty() && !is_valve_file(options.output))
    refuse_usage("--output: " + options.output + " must end in .json, so that other commands accept the file");
  check_set_opening(options, "has no effect, because landmarks are points of the closed valve");
  return options;
}

PatientOptions finish_patient(const Command &command, PatientOptions options) {
  options.has_valve = command.has("--valve");
  if (options.has_valve && is_valve_file(options.valve))
    refuse_usage("--valve: " + options.valve + " is a file; landmarks place a kind of valve");
  if (options.has_valve) use_named_valve(options);
  check_set_opening(options, "has no effect, because the command uses all openings of the valve");
  if (options.noise && options.noise->number < 0) refuse_usage("--noise: " + options.noise->text + " is below 0");
  if (options.hold && options.solver != "openfoam")
    refuse_usage("--hold needs --solver openfoam: only the case for OpenFOAM can hold a valve at an opening");
  if (options.hold && *options.hold >= 1)
    refuse_usage("--hold: the opening must be below 1, but it is 1: write --hold 0.999");
  if (options.heart_rate && options.solver == "none")
    refuse_usage("--heart-rate needs --solver: only the case of a solver has a heart rate");
  if (options.heart_rate && (*options.heart_rate < 40 || *options.heart_rate > 180))
    refuse_usage("--heart-rate: " + shortest(*options.heart_rate) +
                 " is not from 40 to 180 beats a minute, for which the pressures of a case are known");
  if (options.solver == "none") return options;
  const Unit needed = options.solver == "svmultiphysics" ? Unit::centimetre : Unit::metre;
  if (options.unit && *options.unit != needed)
    refuse_usage("--unit: " + options.solver + " takes " + words_of(needed) + ", not " + words_of(*options.unit) +
                 ": leave --unit out, because riis patient converts");
  options.unit = needed;
  return options;
}

// ---- Values that follow from options ----

const std::vector<std::string> &triangulation_names() {
  static const std::vector<std::string> names = {"adapted", "fixed"};
  return names;
}

void apply_units(ValveOptions &options) {
  options.surface_options.scale = factor_between(options.surface_unit.value_or(Unit::centimetre), *options.unit);
  if (!options.has_half_thickness) options.surface_options.half_thickness = paper_half_thickness(*options.unit);
}

void apply_amounts(MarkOptions &options) {
  const bool has_fields = is_foam_case(options.output) || is_foam_time(options.output);
  if (options.density && !has_fields)
    refuse_usage("--density has no effect: K is divided by the density only in the fields of an OpenFOAM case");
  if (!options.given_resistance) return;
  const Amount &given = *options.given_resistance;
  if (given.number < 0) throw Refusal{given.exit_code, given.subject + " is " + given.text + "; it must be at least 0"};
  options.resistance = in_mesh_units(given, a_resistance, options.unit);
  if (options.given_drop) static_cast<void>(in_mesh_units(*options.given_drop, a_pressure, options.unit));
  if (options.unit) {
    options.K_unit = unit_text(a_K, *options.unit);
    options.K_u_surface_unit = unit_text(a_K_u_surface, *options.unit);
  }
  if (has_fields) {
    if (!options.density)
      refuse_usage("--output " + options.output +
                   ": OpenFOAM's K is divided by the density: write --density RHO, and R in " + a_resistance.si +
                   " as --resistance");
    if (options.chosen_K_unit)
      refuse_usage("--k-unit has no effect on the fields of OpenFOAM, because their K has the unit 1/s");
    options.K_factor = 1 / in_mesh_units(*options.density, a_density, options.unit);
    options.K_unit = "1/s";
    options.K_u_surface_unit = options.unit ? std::string(name_of(*options.unit)) + "/s2" : "";
  } else if (options.chosen_K_unit) {
    const double si = parse_unit_of(*options.chosen_K_unit, "--k-unit", a_K);
    if (!options.unit) refuse_usage("--k-unit needs the unit of the mesh: write --unit m, cm or mm");
    options.K_factor = 1 / (si * factor_from_si(a_K, *options.unit));
    options.K_unit = *options.chosen_K_unit;
    options.K_u_surface_unit = options.K_unit + " " + name_of(*options.unit) + "/s";
  }
}

bool sets_opening(const ValveOptions &options) { return options.opening || has_set_opening(options); }

bool is_prefix(const std::string &name) {
  const auto is_good = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), is_good);
}

}  // namespace riis::program
