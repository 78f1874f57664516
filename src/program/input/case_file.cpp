// SPDX-License-Identifier: Apache-2.0

#include "program/input/case.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/json.hpp"
#include "program/input/opening_law.hpp"
#include "program/input/parameters.hpp"
#include "program/input/valve_file.hpp"
#include "program/input/valve_source.hpp"
#include "program/input/wall.hpp"
#include "program/output/outputs.hpp"

namespace riis::program {

namespace {

const std::vector<std::string> case_keys = {"mesh",       "unit",  "half_thickness", "offset",      "distance_limit",
                                            "resistance", "times", "valves",         "check_leaks", "cells_where"};
const std::vector<std::string> valve_keys = {
    "name",      "valve",          "surface",      "leaflets",       "parameters",    "open_parameters",
    "opening",   "half_thickness", "resistance",   "scale",          "surface_unit",  "rotate",
    "translate", "tolerance",      "flip_normals", "skip_zero_area", "triangulation", "period",
    "warp",      "skirt",          "wall",         "time_step",      "offset"};

class CaseReader {
 public:
  explicit CaseReader(const MarkOptions &options) : path_(options.series.case_file), all_{options, {}, {}} {}

  Case read() {
    const Json root = parse_json_file(path_, "a case");
    const CaseValues values(path_, "", root, case_keys);
    read_common(values);
    const Json &valves = values.needed("valves");
    if (!valves.is_array() || valves.empty()) values.refuse("valves", "it must be an array of at least one valve");
    for (std::size_t i = 0; i < valves.size(); ++i) read_valve(valves[i], i, valves.size());
    apply_resistances(values);
    read_surfaces(all_);
    return std::move(all_);
  }

 private:
  void read_common(const CaseValues &values) {
    MarkOptions &options = all_.options;
    if (options.mesh.empty() && !options.check_crossing) options.mesh = file_of(values, "mesh");
    if (options.mesh.empty() && options.needs_mesh)
      values.refuse("mesh", "it is missing, and no MESH is on the command line");
    if (options.cells_where.empty()) options.cells_where = values.text("cells_where");
    options.unit = values.unit("unit");
    if (const auto length = values.above_zero("half_thickness")) {
      options.has_half_thickness = true;
      options.surface_options.half_thickness = *length;
    }
    if (const auto offset = values.number("offset")) options.surface_options.offset = *offset;
    const auto limit = values.above_zero("distance_limit");
    if (limit && options.mark_options.distance_limit == RIIS_AUTO) options.mark_options.distance_limit = *limit;
    const auto resistance = resistance_of(values);
    if (!options.given_resistance) options.given_resistance = resistance;
    if (values.has("check_leaks") && !options.check_leaks) options.check_leaks = leak_check_of(values);
    if (values.has("times") && options.series.times.empty()) options.series.times = times_of(values);
  }

  // Reads R, which is a number or a text with a unit.
  static std::optional<Amount> resistance_of(const CaseValues &values) {
    const char *const key = "resistance";
    if (!values.has(key)) return std::nullopt;
    const std::string subject = values.subject() + ": " + key;
    if (!values.needed(key).is_string())
      return Amount{*values.at_least_zero(key), false, values.needed(key).dump(), subject, exit_bad_data};
    try {
      Amount amount = parse_amount(values.text(key), subject, a_resistance);
      if (amount.number < 0) values.refuse(key, values.needed(key).dump() + " is below 0");
      amount.exit_code = exit_bad_data;
      return amount;
    } catch (Refusal &refusal) {
      refusal.exit_code = exit_bad_data;
      throw;
    }
  }

  // Converts the resistance R of each valve into the units of the mesh. K is a sum over the valves, so all valves need the same
  // unit of the mesh. Without "unit", a placed valve has the unit of its file.
  void apply_resistances(const CaseValues &values) {
    const ValveSource *first = nullptr;
    for (ValveSource &valve : all_.valves) {
      if (!valve.options.given_resistance) continue;
      if (!first) first = &valve;
      if (valve.options.unit != first->options.unit)
        values.refuse("unit", "it is missing, and R of " + first->options.prefix + " and R of " + valve.options.prefix +
                                  " have different units");
      apply_amounts(valve.options);
    }
    if (!first && all_.options.density) apply_amounts(all_.options);
  }

  LeakCheck leak_check_of(const CaseValues &values) const {
    return {values.numbers("check_leaks", 6), path_ + ": check_leaks", exit_bad_data};
  }

  std::vector<double> times_of(const CaseValues &values) const {
    const std::string subject = path_ + ": times";
    try {
      const Json &times = values.needed("times");
      if (times.is_string()) return parse_times(times.get<std::string>(), subject);
      const std::vector<double> numbers = values.numbers("times");
      check_times(numbers, subject);
      return numbers;
    } catch (Refusal &refusal) {
      refusal.exit_code = exit_bad_data;
      throw;
    }
  }

  // Returns the path that a key gives, or "" if the key is missing. A relative path starts from the case's folder.
  std::string file_of(const CaseValues &values, const char *key) {
    const std::string text = values.text(key);
    if (text.empty()) return "";
    all_.files.push_back(in_folder(text));
    return all_.files.back();
  }

  // Returns the paths that a key gives. The value of the key is a text or an array of texts.
  std::vector<std::string> files_of(const CaseValues &values, const char *key) {
    if (!values.needed(key).is_array()) return {file_of(values, key)};
    std::vector<std::string> files;
    for (const Json &item : values.needed(key)) {
      if (!item.is_string() || item.get<std::string>().empty()) values.refuse(key, item.dump() + " is not a path");
      files.push_back(in_folder(item.get<std::string>()));
    }
    if (files.empty()) values.refuse(key, "it names no file");
    all_.files.insert(all_.files.end(), files.begin(), files.end());
    return files;
  }

  std::string in_folder(const std::string &path) const {
    return (std::filesystem::path(path_).parent_path() / path).string();
  }

  void read_valve(const Json &value, std::size_t number, std::size_t n_valves) {
    CaseValues values(path_, "valve " + std::to_string(number), value, valve_keys);
    ValveSource source{all_.options, nullptr, nullptr};
    MarkOptions &options = source.options;
    options.prefix = name_of(values, n_valves);
    if (n_valves > 1) values.set_subject("valve \"" + options.prefix + "\"");
    source.subject = values.subject();
    if (values.has("surface")) set_surface(options, files_of(values, "surface"), source.subject);
    options.leaflets = values.text("leaflets");
    if (options.surface_files.size() > 1 && !options.leaflets.empty())
      values.refuse("leaflets", "it has no effect, because each file of the list is one leaflet");
    options.valve = values.text("valve");
    if (options.valve.empty() == options.surface.empty())
      values.refuse("valve", "either it or \"surface\" must be given");
    if (is_valve_file(options.valve)) options.valve = file_of(values, "valve");
    use_named_valve(options);
    read_placement(values, options);
    if (const auto own = resistance_of(values)) options.given_resistance = own;
    options.skirt = values.above_zero("skirt");
    options.wall = file_of(values, "wall");
    if (!options.wall.empty() && !options.skirt) values.refuse("wall", "it needs \"skirt\", the longest skirt");
    if (options.surface.empty())
      make_valve_of(values, source);
    else
      make_surface_of(values, source);
    all_.valves.push_back(std::move(source));
  }

  std::string name_of(const CaseValues &values, std::size_t n_valves) {
    const std::string name = values.text("name");
    if (name.empty()) {
      if (n_valves > 1) values.refuse("name", "it is missing, and each of several valves needs a name");
      return all_.options.prefix;
    }
    if (!is_prefix(name))
      values.refuse("name", "\"" + name + "\" must have 1 to 64 characters: letters, digits, _, - and .");
    if (n_valves > 1 && name == all_.options.prefix)
      values.refuse("name", "\"" + name + "\" is already the name of the sums over all valves");
    if (!names_.insert(name).second) values.refuse("name", "\"" + name + "\" is already the name of another valve");
    return name;
  }

  void read_placement(const CaseValues &values, MarkOptions &options) const {
    if (!options.placed.empty())
      for (const char *key : {"scale", "surface_unit", "rotate", "translate"})
        if (values.has(key)) values.refuse(key, "it has no effect, because the placement is in " + options.placed);
    riis_surface_options &surface = options.surface_options;
    if (const auto scale = values.above_zero("scale")) {
      if (options.unit)
        values.refuse("scale", "it cannot be combined with \"unit\", because the unit determines the scale");
      options.has_scale = true;
      surface.scale = *scale;
    }
    if (const auto own = values.above_zero("half_thickness")) {
      options.has_half_thickness = true;
      surface.half_thickness = *own;
    }
    if (const auto offset = values.number("offset")) surface.offset = *offset;
    options.surface_unit = values.unit("surface_unit");
    if (options.surface_unit && !options.unit)
      values.refuse("surface_unit", "it needs the unit of the mesh, as in \"unit\": \"mm\"");
    const bool is_file = !options.surface.empty() || is_valve_file(options.valve);
    if (options.unit && is_file && !options.surface_unit)
      values.refuse("surface_unit", "it is missing, but with \"unit\" it must give the unit of the file");
    if (options.surface_unit && !is_file && options.surface_unit != Unit::centimetre)
      values.refuse("surface_unit", "the parameters of the " + options.valve + " valve are in centimetres");
    if (options.unit) apply_units(options);
    if (values.has("rotate")) {
      const std::vector<double> turn = values.numbers("rotate", 4);
      std::copy_n(turn.begin(), 3, surface.rotation_axis);
      surface.rotation_angle = turn[3];
    }
    if (values.has("translate")) {
      const std::vector<double> shift = values.numbers("translate", 3);
      std::copy_n(shift.begin(), 3, surface.translation);
    }
    if (const auto tolerance = values.above_zero("tolerance")) surface.tolerance = *tolerance;
    surface.flip_normals = values.flag("flip_normals");
    surface.triangulation = static_cast<int32_t>(values.choice("triangulation", triangulation_names()));
    surface.zero_area = values.flag("skip_zero_area") ? RIIS_ZERO_AREA_SKIP : RIIS_ZERO_AREA_REFUSE;
  }

  void make_valve_of(const CaseValues &values, ValveSource &source) {
    for (const char *key : {"leaflets", "skip_zero_area", "period", "time_step"})
      if (values.has(key)) values.refuse(key, "it needs \"surface\"");
    const std::string &kind = source.options.valve;
    if (is_valve_file(kind) && values.has("open_parameters"))
      values.refuse("open_parameters", "the open state is in " + kind);
    NewValve valve(kind, source.subject);
    set_own_parameters(source.options, valve);
    set_parameters_of(values, "parameters", valve);
    if (values.has("open_parameters")) {
      const Valve open = make_kind(kind, source.subject);
      set_parameters_of(values, "open_parameters", open);
      check(riis_valve_set_open_state(valve, open), source.subject);
      source.has_open_state = true;
    }
    set_law(values, valve, source);
    set_warp(values, valve, source);
    source.valve = valve.take();
    set_skirt(source.options, source.valve, source.subject);
  }

  // Reads the warp, and warps the valve to the landmarks of the first time.
  void set_warp(const CaseValues &values, riis_valve *valve, ValveSource &source) {
    const std::vector<double> &times = all_.options.series.times;
    source.warp = read_warp(source.options);
    if (values.has("warp")) {
      if (!source.warp.is_empty())
        values.refuse("warp", "it has no effect, because " + source.options.placed + " has a warp");
      const std::string object = (values.subject() + ": warp").substr(path_.size() + 2);
      source.warp = WarpSource(path_, object, values.needed("warp"), source.options.surface_options);
    }
    if (times.empty() && source.warp.moves())
      values.refuse("warp", "landmarks that move need times, from the case file or from --times");
    source.warp.apply(times.empty() ? 0 : times.front(), valve);
  }

  // Sets parameters from an object, or from the file at a path.
  void set_parameters_of(const CaseValues &values, const char *key, riis_valve *valve) {
    if (!values.has(key)) return;
    if (values.needed(key).is_string())
      set_from_json_file(valve, file_of(values, key));
    else
      set_from_json(valve, values.needed(key), values.subject() + ": " + key);
  }

  // Sets the law of opening. Also opens the valve as far as the law requires. Fails if the valve cannot open.
  void set_law(const CaseValues &values, riis_valve *valve, ValveSource &source) {
    const std::vector<double> &times = all_.options.series.times;
    source.law = OpeningLaw(opening_of(valve));
    if (values.has("opening")) {
      const CaseOpening found = case_opening(values, [this](const std::string &path) { return in_folder(path); });
      source.law = found.law;
      if (!found.file.empty()) all_.files.push_back(found.file);
    }
    if (times.empty() && !source.law.is_constant())
      values.refuse("opening", "a valve that moves needs times, from the case file or from --times");
    check(riis_valve_set_scalar(valve, "opening", largest_opening(source.law, times)), source.subject);
  }

  void make_surface_of(const CaseValues &values, ValveSource &source) {
    for (const char *key : {"parameters", "open_parameters", "opening", "tolerance", "triangulation", "warp"})
      if (values.has(key)) values.refuse(key, "it cannot be combined with \"surface\"");
    if (is_motion(source.options)) {
      if (!all_.is_series())
        values.refuse("surface", "a surface that moves needs times, from the case file or from --times");
      source.options.period = values.above_zero("period").value_or(0);
      source.options.frame_step = values.above_zero("time_step").value_or(1);
    } else {
      for (const char *key : {"period", "time_step"})
        if (values.has(key)) values.refuse(key, "it needs a \"surface\" that moves: a .pvd or .dat file");
    }
  }

  const std::string &path_;
  Case all_;
  std::set<std::string> names_;
};

}  // namespace

Case read_case(const MarkOptions &options) { return CaseReader(options).read(); }

// ---- Case opening ----

namespace {

const std::vector<std::string> table_keys = {"times", "openings", "period", "interpolation"};
const std::vector<std::string> cycle_keys = {"file", "period", "interpolation"};
const std::vector<std::string> ramp_keys = {
    "opening_start", "opening_duration", "closing_start", "closing_duration", "closed", "open", "period"};

OpeningLaw law_of_table(const CaseValues &values, OpeningTable table, const std::string &subject) {
  table.period = values.above_zero("period").value_or(0);
  table.interpolation = static_cast<std::int32_t>(values.choice("interpolation", interpolation_names()));
  return OpeningLaw(std::move(table), subject);
}

OpeningLaw law_of_arrays(const CaseValues &values) {
  const OpeningTable table{values.numbers("times"), values.numbers("openings")};
  if (table.times.size() != table.openings.size()) {
    values.refuse("openings", "there are " + std::to_string(table.openings.size()) + " for " +
                                  std::to_string(table.times.size()) + " times");
  }
  return law_of_table(values, table, values.subject());
}

OpeningLaw law_of_ramps(const CaseValues &values) {
  auto times = defaults<riis_opening_times>();
  const std::pair<const char *, double *> needed[] = {{"opening_start", &times.opening_start},
                                                      {"opening_duration", &times.opening_duration},
                                                      {"closing_start", &times.closing_start},
                                                      {"closing_duration", &times.closing_duration}};
  for (const auto &[key, field] : needed) static_cast<void>(values.needed(key));
  for (const auto &[key, field] : needed) *field = *values.number(key);
  times.closed = values.number("closed").value_or(times.closed);
  times.open = values.number("open").value_or(times.open);
  times.period = values.above_zero("period").value_or(0);
  return OpeningLaw(times, values.subject());
}

}  // namespace

CaseOpening case_opening(const CaseValues &valve, const std::function<std::string(const std::string &)> &in_folder) {
  const Json &value = valve.needed("opening");
  if (value.is_number()) {
    const double opening = value.get<double>();
    if (!(opening >= 0 && opening <= 1)) valve.refuse("opening", value.dump() + " is not from 0 to 1");
    return {OpeningLaw(opening), ""};
  }
  const std::string object = valve.subject().substr(valve.path().size() + 2) + ": opening";
  if (!value.is_object()) valve.refuse("opening", value.dump() + " is neither a number nor an object");
  if (value.contains("file")) {
    const CaseValues values(valve.path(), object, value, cycle_keys);
    const std::string file = in_folder(values.text("file"));
    return {law_of_table(values, read_cycle(file), file), file};
  }
  if (value.contains("times")) return {law_of_arrays({valve.path(), object, value, table_keys}), ""};
  if (value.contains("opening_start")) return {law_of_ramps({valve.path(), object, value, ramp_keys}), ""};
  valve.refuse("opening", "it must have file, times or opening_start");
}

namespace {

void read_valve(const MarkOptions &options, ValveSource &source) {
  source.has_open_state = !options.params_open.empty();
  if (options.series.times.empty()) {
    source.valve = make_valve(options);
    source.law = OpeningLaw(opening_of(source.valve));
    return;
  }
  const SeriesOptions &series = options.series;
  source.law = OpeningLaw(read_cycle(series.cycle, options.period, series.interpolation), series.cycle);
  // make_valve gets the largest opening, so that it can refuse a file of patches if the valve cannot open so far.
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
    if (!is_motion(options)) {
      source.file = read_surface(options, all.seconds);
      continue;
    }
    KeyframeFiles read = read_keyframes(options, all.seconds);
    // Outputs are written after all frames are read. Without this check, an output could replace a frame, and the user would not
    // notice.
    check_no_output_is("a frame of --surface " + options.surface, read.files, options);
    source.keyframes = std::move(read.keyframes);
    all.files.insert(all.files.end(), read.files.begin(), read.files.end());
  }
}

}  // namespace riis::program
