// SPDX-License-Identifier: Apache-2.0
#include "program/patient/openfoam_valve.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "program/base/handles.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/parameters.hpp"
#include "program/input/valve_source.hpp"
#include "program/input/warp_source.hpp"

namespace riis::program {
namespace {

std::string foam_brackets(const double *numbers, std::size_t n) { return "(" + numbers_text(numbers, n, " ") + ")"; }

std::string foam_points_of(const std::vector<double> &xyz) {
  std::string list;
  for (std::size_t i = 0; i < xyz.size(); i += 3) list += "\n        " + foam_brackets(xyz.data() + i, 3);
  return "\n    (" + list + "\n    );\n";
}

// Returns the entry of the warp, or "" if the valve has none.
std::string foam_warp_of(const std::string &path, const PlacedFile &file) {
  if (file.warp.is_null()) return "";
  const WarpSource warp(path, "warp", file.warp, file.where, file.factor);
  if (warp.moves() || warp.pairs().size() > 1)
    refuse_data(path + ": the warp moves, and OpenFOAM's dictionary takes a warp that rests or follows the mesh");
  if (!warp.is_in_mesh())
    refuse_data(path + ": the warp's landmarks are in the valve's coordinates, and OpenFOAM takes those of the mesh");
  return "warp\n{\n    sources" + foam_points_of(warp.pairs()[0].sources()) + "    targets" +
         foam_points_of(warp.pairs()[0].targets()) + "    noise           " + shortest(warp.noise()) + ";\n}\n";
}

}  // namespace

std::string foam_valve_of(const std::string &path, const Json &root, double longest) {
  const PlacedFile file = read_placed(path, root, Unit::metre);
  const Valve valve = make_kind(file.kind, path);
  set_from_json(valve, file.parameters, path + ": parameters");
  std::string text = "valve\n{\n    kind            " + file.kind + ";\n", skirt;
  const std::vector<riis_parameter> parameters = all_parameters(valve);
  for (const riis_parameter &parameter : parameters) {
    const std::vector<double> values = values_of(valve, parameter);
    const auto is_its_rule = [&](const riis_parameter &other) {
      return std::string(parameter.rule) == other.name && values_of(valve, other) == values;
    };
    const std::string name = parameter.name;
    if (name == "skirt_length" && values[0] == 0 && longest > 0)
      skirt = "skirt\n{\n    patch           wall;\n    longest         " + shortest(longest) + ";\n}\n";
    // A parameter need not be written if it follows from another parameter. Any other parameter need not be written if it has its
    // default.
    std::int32_t is_set = 0;
    check(riis_valve_is_set(valve, parameter.name, &is_set));
    if (is_set == 0 || name == "opening" || std::any_of(parameters.begin(), parameters.end(), is_its_rule)) continue;
    if (*parameter.rule == 0 && std::equal(values.begin(), values.end(), parameter.default_values)) continue;
    text += "    " + name + " " +
            (values.size() == 1 ? shortest(values[0]) : foam_brackets(values.data(), values.size())) + ";\n";
  }
  const riis_surface_options &at = file.where;
  return text + "}\nplacement\n{\n    scale           " + shortest(at.scale) + ";\n    rotationAxis    " +
         foam_brackets(at.rotation_axis, 3) + ";\n    rotationAngle   " + shortest(at.rotation_angle) +
         ";\n    translation     " + foam_brackets(at.translation, 3) + ";\n}\n" + foam_warp_of(path, file) + skirt;
}

}  // namespace riis::program
