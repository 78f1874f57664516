// SPDX-License-Identifier: Apache-2.0
#include "program/input/placed_valve.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <vector>

#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/parameters.hpp"
#include "program/input/valve_file.hpp"

namespace riis::program {
namespace {

// Returns whether the file is JSON with a kind of valve. Files that cannot be read are refused later, by their own reader.
bool names_kind(const std::string &path) {
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (text.find("\"valve\"") == std::string::npos) return false;
  const Json root = Json::parse(text, nullptr, false);
  return root.is_object() && root.contains("valve");
}

}  // namespace

PlacedFile read_placed(const std::string &path, const Json &root, std::optional<Unit> unit) {
  const CaseValues values(path, "", root,
                          {"valve", "unit", "axes", "rotate", "translate", "parameters", "landmarks", "fit", "warp"},
                          "a placed valve");
  PlacedFile file;
  file.kind = values.text("valve");
  if (file.kind.empty() || has_ending(file.kind, ".json")) values.refuse("valve", "it must be a kind of valve");
  values.needed("unit");
  const Unit own = *values.unit("unit");
  file.unit = unit.value_or(own);
  file.factor = factor_between(own, file.unit);
  check(riis_surface_options_init(&file.where, sizeof file.where));
  const std::vector<double> turn = values.numbers("rotate", 4), shift = values.numbers("translate", 3);
  file.where.scale = factor_between(Unit::centimetre, file.unit);
  std::copy_n(turn.begin(), 3, file.where.rotation_axis);
  file.where.rotation_angle = turn[3];
  for (std::size_t k = 0; k < 3; ++k) file.where.translation[k] = file.factor * shift[k];
  file.parameters = values.needed("parameters");
  if (values.has("warp")) file.warp = values.needed("warp");
  return file;
}

void use_placed_valve(ValveOptions &options) {
  if (!is_valve_file(options.valve) || !names_kind(options.valve)) return;
  const std::string path = options.valve;
  const PlacedFile file = read_placed(path, parse_json_file(path, "a placed valve"), options.unit);
  riis_surface_options &surface = options.surface_options;
  if (options.surface_unit) refuse_usage("--surface-unit has no effect with --valve " + path + ", which has a unit");
  if (options.has_scale) refuse_usage("--scale has no effect with --valve " + path + ": --unit says the mesh's unit");
  const bool is_moved =
      surface.rotation_angle != 0 ||
      std::any_of(std::begin(surface.translation), std::end(surface.translation), [](double x) { return x != 0; });
  if (is_moved) refuse_usage("--rotate and --translate have no effect with --valve " + path + ", which is placed");
  options.valve = file.kind;
  options.placed = path;
  options.unit = file.unit;
  std::copy_n(file.where.rotation_axis, 3, surface.rotation_axis);
  surface.rotation_angle = file.where.rotation_angle;
  std::copy_n(file.where.translation, 3, surface.translation);
}

void set_placed_parameters(const ValveOptions &options, riis_valve *valve) {
  if (options.placed.empty()) return;
  const Json root = parse_json_file(options.placed, "a placed valve");
  set_from_json(valve, root.at("parameters"), options.placed + ": parameters");
}

}  // namespace riis::program
