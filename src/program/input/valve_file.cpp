// SPDX-License-Identifier: Apache-2.0

#include "program/input/valve_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <regex>
#include <unordered_map>
#include <vector>

#include "common/array_view.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/json.hpp"
#include "program/input/parameters.hpp"

namespace riis::program {

namespace {

constexpr std::array<const char *, 4> side_keys = {"v0", "v1", "u0", "u1"};

// The curves of one state of the valve, and the arrays in which the library takes them.
struct Curves {
  std::vector<std::string> names;
  std::unordered_map<std::string, std::int32_t> position;
  std::vector<std::int32_t> degrees;
  std::vector<double> control;
};

struct Patches {
  std::vector<std::int32_t> curve_ids, reversed, leaflet_ids;
};

class CurveFileReader {
 public:
  explicit CurveFileReader(const std::string &path) : path_(path) {}

  // In refusals, `where` comes before the names of curves. It is "" or "open: ".
  Curves curves_of(const Json &root, const std::string &where) const {
    const Json &list = member(root, "curves", where);
    if (!list.is_object())
      refuse(where + "\"curves\" must be an object of curves by name, not of type " + list.type_name());
    if (list.empty()) refuse(where + "\"curves\" is empty");
    Curves curves;
    for (const auto &[name, points] : list.items()) {
      check_name(name, where);
      curves.position.emplace(name, static_cast<std::int32_t>(curves.names.size()));
      curves.names.push_back(name);
      add_points(points, where + "curve " + quoted(name), curves);
    }
    return curves;
  }

  Patches patches_of(const Json &root, const Curves &curves) const {
    const Json &list = member(root, "patches", "");
    if (!list.is_array())
      refuse(std::string("\"patches\" must be an array of patches, not of type ") + list.type_name());
    if (list.empty()) refuse("\"patches\" is empty");
    Patches patches;
    std::vector<bool> used(curves.names.size(), false);
    for (std::size_t i = 0; i < list.size(); ++i)
      add_patch(list[i], "patch " + std::to_string(i), curves, used, patches);
    const auto idle = std::find(used.begin(), used.end(), false);
    if (idle != used.end()) {
      refuse("curve " + quoted(view(curves.names)[idle - used.begin()]) + " is a side of no patch");
    }
    return patches;
  }

  // Returns the curves of the open state, in the order of the closed state's curves.
  Curves open_curves_of(const Json &open, const Curves &closed) const {
    check_object(open, "\"open\"", {"curves"});
    const Curves found = curves_of(open, "open: ");
    for (const std::string &name : found.names) {
      if (closed.position.count(name) == 0)
        refuse("open: curve " + quoted(name) + " is not a curve of the closed state");
    }
    Curves ordered{closed.names, closed.position, {}, {}};
    std::vector<std::size_t> begins = {0};
    for (const std::int32_t degree : found.degrees) begins.push_back(begins.back() + 3 * n_control_points(degree));
    for (std::size_t i = 0; i < closed.names.size(); ++i) {
      const auto place = found.position.find(closed.names[i]);
      if (place == found.position.end()) refuse("open: curve " + quoted(closed.names[i]) + " is missing");
      const auto at = static_cast<std::size_t>(place->second);
      if (found.degrees[at] != closed.degrees[i])
        refuse("open: curve " + quoted(closed.names[i]) + " has degree " + std::to_string(found.degrees[at]) +
               ", in the closed state " + std::to_string(closed.degrees[i]));
      ordered.degrees.push_back(found.degrees[at]);
      ordered.control.insert(ordered.control.end(), found.control.begin() + static_cast<std::ptrdiff_t>(begins[at]),
                             found.control.begin() + static_cast<std::ptrdiff_t>(begins[at + 1]));
    }
    return ordered;
  }

  void check_object(const Json &value, const std::string &subject, const std::vector<std::string> &keys) const {
    check_keys(path_, subject, value, keys);
  }

  [[noreturn]] void refuse(const std::string &reason) const { refuse_file(path_, reason); }

 private:
  static std::size_t n_control_points(std::int32_t degree) { return static_cast<std::size_t>(degree) + 1; }

  const Json &member(const Json &object, const char *key, const std::string &where) const {
    const auto found = object.find(key);
    if (found == object.end()) refuse(where + quoted(key) + " is missing");
    return *found;
  }

  void check_name(const std::string &name, const std::string &where) const {
    if (name.empty()) refuse(where + "a curve has an empty name");
    if (name[0] == '-')
      refuse(where + "curve " + quoted(name) + ": a name must not begin with a minus, which turns a side");
  }

  void add_points(const Json &points, const std::string &curve, Curves &curves) const {
    if (!points.is_array()) refuse(curve + " must be an array of 1 to 4 points, not of type " + points.type_name());
    if (points.empty() || points.size() > 4) {
      refuse(curve + " has " + std::to_string(points.size()) + " points; it must have 1 to 4");
    }
    for (std::size_t i = 0; i < points.size(); ++i)
      add_point(points[i], curve + ": point " + std::to_string(i), curves);
    // If a side collapses to a point, it is stored as a line of length 0.
    if (points.size() == 1) add_point(points[0], curve, curves);
    curves.degrees.push_back(std::max(1, static_cast<std::int32_t>(points.size()) - 1));
  }

  void add_point(const Json &value, const std::string &subject, Curves &curves) const {
    const auto point = point_in(value);
    if (!point) refuse(subject + " is " + value.dump() + "; it must be three numbers, [x, y, z]");
    curves.control.insert(curves.control.end(), point->begin(), point->end());
  }

  void add_patch(const Json &patch, const std::string &subject, const Curves &curves, std::vector<bool> &used,
                 Patches &patches) const {
    check_object(patch, subject, {"v0", "v1", "u0", "u1", "leaflet"});
    for (const char *key : side_keys) {
      const Json &side = member(patch, key, subject + ": ");
      if (!side.is_string()) refuse(subject + ": " + key + " is " + side.dump() + "; it must be the name of a curve");
      const std::string &text = side.get_ref<const std::string &>();
      const bool reversed = !text.empty() && text[0] == '-';
      const auto found = curves.position.find(text.substr(reversed ? 1 : 0));
      if (found == curves.position.end())
        refuse(subject + ": " + key + " is " + quoted(text) + "; there is no such curve");
      used[static_cast<std::size_t>(found->second)] = true;
      patches.curve_ids.push_back(found->second);
      patches.reversed.push_back(reversed ? 1 : 0);
    }
    const auto leaflet = patch.find("leaflet");
    patches.leaflet_ids.push_back(leaflet == patch.end() ? 0 : leaflet_of(*leaflet, subject));
  }

  std::int32_t leaflet_of(const Json &value, const std::string &subject) const {
    constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
    // As an unsigned number, a negative number is very large, so the comparison also refuses it.
    if (!value.is_number_integer() || value.get<std::uint64_t>() > static_cast<std::uint64_t>(most)) {
      refuse(subject + ": leaflet is " + value.dump() + "; it must be a whole number from 0 to " +
             std::to_string(most));
    }
    return value.get<std::int32_t>();
  }

  const std::string &path_;
};

// In a message of the library, replaces the numbers of curves and the names of sides by the names in the file.
std::string with_names(std::string text, const Curves &curves, const Patches &patches) {
  std::smatch match;
  if (std::regex_search(text, match, std::regex("curve ([0-9]+)"))) {
    const std::size_t curve = std::stoul(match[1]);
    if (curve < curves.names.size()) {
      return match.prefix().str() + "curve " + quoted(curves.names[curve]) + match.suffix().str();
    }
  }
  if (!std::regex_search(text, match, std::regex("patch ([0-9]+)"))) return text;
  const std::size_t patch = std::stoul(match[1]);
  if (4 * patch + 3 >= patches.curve_ids.size()) return text;
  for (std::size_t k = 0; k < side_keys.size(); ++k) {
    const std::string key = side_keys[k];
    const std::string counted = std::string("side ") + key[0] + " = " + key[1];
    const std::size_t place = text.find(counted), side = 4 * patch + k;
    if (place == std::string::npos) continue;
    const std::string &name = view(curves.names)[patches.curve_ids[side]];
    text.replace(place, counted.size(), key + " " + quoted((patches.reversed[side] ? "-" : "") + name));
  }
  return text;
}

Valve make_valve(const CurveFileReader &reader, const Curves &curves, const Patches &patches,
                 const std::string &where) {
  auto arrays = defaults<riis_patches>();
  arrays.n_curves = view(curves.degrees).size();
  arrays.degree = curves.degrees.data();
  arrays.control = curves.control.data();
  arrays.n_patches = view(patches.leaflet_ids).size();
  arrays.curve_id = patches.curve_ids.data();
  arrays.reversed = patches.reversed.data();
  arrays.leaflet_id = patches.leaflet_ids.data();
  Valve valve;
  const riis_status status = riis_valve_create_from_patches(&arrays, valve.out());
  if (status == RIIS_INVALID_PARAMETER || status == RIIS_INVALID_ARGUMENT) {
    reader.refuse(where + with_names(riis_last_error(), curves, patches));
  }
  check(status);
  return valve;
}

}  // namespace

bool is_valve_file(const std::string &valve) { return has_ending(valve, ".json"); }

ValveFile::ValveFile(const std::string &path) {
  const Json root = parse_json_file(path, "curves and patches");
  const CurveFileReader reader(path);
  reader.check_object(root, "the file", {"curves", "patches", "open"});
  const Curves curves = reader.curves_of(root, "");
  const Patches patches = reader.patches_of(root, curves);
  valve = make_valve(reader, curves, patches, "");
  const auto open = root.find("open");
  if (open == root.end()) return;
  const Valve open_valve = make_valve(reader, reader.open_curves_of(*open, curves), patches, "open: ");
  check(riis_valve_set_open_state(valve, open_valve), path);
  can_open = true;
}

namespace {

// Returns whether the file is a JSON file that names a kind of valve. If a file cannot be read, the reader of its format refuses
// it later.
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
  file.own_unit = own;
  file.unit = unit.value_or(own);
  file.factor = factor_between(own, file.unit);
  const std::vector<double> turn = values.numbers("rotate", 4), shift = values.numbers("translate", 3);
  file.where.scale = factor_between(Unit::centimetre, file.unit);
  std::copy_n(turn.begin(), 3, file.where.rotation_axis);
  file.where.rotation_angle = turn[3];
  for (std::size_t k = 0; k < 3; ++k) file.where.translation[k] = file.factor * shift[k];
  file.parameters = values.needed("parameters");
  if (values.has("warp")) file.warp = values.needed("warp");
  return file;
}

void use_named_valve(ValveOptions &options) {
  if (const Disease *const disease = disease_named(options.valve)) {
    options.disease = options.valve;
    options.valve = disease->kind;
    return;
  }
  if (!is_valve_file(options.valve) || !names_kind(options.valve)) return;
  const std::string path = options.valve;
  const PlacedFile file = read_placed(path, parse_json_file(path, "a placed valve"), options.unit);
  riis_surface_options &surface = options.surface_options;
  if (options.surface_unit) refuse_usage("--surface-unit has no effect with --valve " + path + ", which has a unit");
  if (options.has_scale) refuse_usage("--scale has no effect with --valve " + path + ": --unit gives the mesh's unit");
  const bool is_moved =
      surface.rotation_angle != 0 ||
      std::any_of(std::begin(surface.translation), std::end(surface.translation), [](double x) { return x != 0; });
  if (is_moved) refuse_usage("--rotate and --translate have no effect with --valve " + path + ", which is placed");
  options.valve = file.kind;
  options.placed = path;
  options.takes_placed_unit = !options.unit;
  options.unit = file.unit;
  options.placed_unit = file.own_unit;
  std::copy_n(file.where.rotation_axis, 3, surface.rotation_axis);
  surface.rotation_angle = file.where.rotation_angle;
  std::copy_n(file.where.translation, 3, surface.translation);
}

void set_own_parameters(const ValveOptions &options, riis_valve *valve) {
  if (const Disease *const disease = disease_named(options.disease))
    set_from_json(valve, Json::parse(disease->parameters), options.disease);
  if (options.placed.empty()) return;
  const Json root = parse_json_file(options.placed, "a placed valve");
  set_from_json(valve, root.at("parameters"), options.placed + ": parameters");
}

}  // namespace riis::program
