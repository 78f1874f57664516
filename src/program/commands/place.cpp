// SPDX-License-Identifier: Apache-2.0
#include "program/commands/commands.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "program/base/handles.hpp"
#include "program/base/progress.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/mesh_reading.hpp"
#include "program/input/parameters.hpp"
#include "program/input/placing.hpp"
#include "program/input/valve_file.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/crossings.hpp"
#include "program/output/outputs.hpp"
#include "program/patient/solver_case.hpp"

namespace riis::program {
namespace {

Placed place(const PlaceOptions &options, Valve &valve) {
  const std::string named = options.has_valve ? options.valve : "";
  LandmarkFile landmarks = read_landmarks(options.landmarks, text_of_file(options.landmarks), named);
  adapt(landmarks, {Reader::program, options.unit, options.axes, options.noise, options.flow});
  const std::string kind = kind_of(landmarks, named, Reader::program);
  check_names_of_cusps(landmarks, kind);
  valve = make_kind(kind, options.has_valve ? "--valve" : options.landmarks);
  set_own_parameters(options, valve);
  if (!options.params.empty()) set_from_json_file(valve, options.params);
  if (!landmarks.parameters.is_null()) set_from_json(valve, landmarks.parameters, options.landmarks + ": parameters");
  std::vector<std::string> held;
  for (const std::string &setting : options.settings) {
    set_from_text(valve, setting);
    held.push_back(setting.substr(0, setting.find('=')));
  }
  Placed placed = place_by_landmarks(landmarks, valve, kind, held, Reader::program);
  if (options.warp_choice != no_warp)
    warp_to_landmarks(placed, valve, options.warp_choice == smoothed_warp ? placed.noise : 0, Reader::program);
  return placed;
}

void check_mesh(const PlaceOptions &options, const Placed &placed) {
  if (options.mesh.empty()) return;
  const MeshFile mesh = [&] {
    const Stage stage("reading " + options.mesh, options.quiet);
    return read_mesh_file(options.mesh, options.cells_where);
  }();
  int64_t n_nodes = 0;
  const double *nodes = nullptr;
  check(riis_vtk_mesh_get_nodes(mesh, &n_nodes, nullptr, &nodes));
  check_at_nodes(placed.landmarks, n_nodes, nodes, " of " + options.mesh, Reader::program);
}

// ---- Lines for C and Fortran ----

bool is_changed(const Size &size) {
  return std::string(size.parameter.name) != "opening" && !size.follows &&
         !std::equal(size.values.begin(), size.values.end(), size.parameter.default_values);
}

std::string c_of(const Placed &placed) {
  const riis_placement &at = placed.placement;
  std::string text = "riis_valve *valve = NULL;\nriis_surface *surface = NULL;\nriis_surface_options options;\n";
  text += "riis_valve_create(\"" + placed.kind + "\", &valve);\n";
  for (const Size &size : placed.sizes) {
    if (!is_changed(size)) continue;
    const std::string values = numbers_text(size.values.data(), size.values.size(), ", ");
    text += size.values.size() == 1
                ? "riis_valve_set_scalar(valve, \"" + std::string(size.parameter.name) + "\", " + values + ");\n"
                : "riis_valve_set(valve, \"" + std::string(size.parameter.name) + "\", " +
                      std::to_string(size.values.size()) + ", (const double[]){" + values + "});\n";
  }
  text += "riis_surface_options_init(&options, sizeof options);\noptions.scale = " + shortest(at.scale) + ";\n";
  for (int k = 0; k < 3; ++k)
    text += "options.rotation_axis[" + std::to_string(k) + "] = " + shortest(at.rotation_axis[k]) + ";\n";
  text += "options.rotation_angle = " + shortest(at.rotation_angle) + ";\n";
  for (int k = 0; k < 3; ++k)
    text += "options.translation[" + std::to_string(k) + "] = " + shortest(at.translation[k]) + ";\n";
  if (placed.is_warped) {
    const std::string n = std::to_string(placed.sources.size() / 3);
    const auto array = [&](const char *name, const std::vector<double> &xyz) {
      std::string made = std::string("const double ") + name + "[][3] = {";
      for (std::size_t i = 0; i < xyz.size(); i += 3)
        made += (i == 0 ? "\n  {" : ",\n  {") + numbers_text(xyz.data() + i, 3, ", ") + "}";
      return made + "};\n";
    };
    text += "/* The warp moves landmarks on the valve to the patient's landmarks. */\n" +
            array("on_valve", placed.sources) + array("in_patient", placed.targets) +
            "riis_points sources, targets;\nriis_warp_options warp_options;\nriis_warp *warp = NULL;\n";
    for (const auto &[points, from] : {std::pair("sources", "on_valve"), std::pair("targets", "in_patient")}) {
      const std::string to = points;
      text += "riis_points_init(&" + to + ", sizeof " + to + ");\n" + to + ".n_points = " + n + ";\n" + to +
              ".stride = 3;\n";
      for (int k = 0; k < 3; ++k) text += to + "." + "xyz"[k] + " = &" + from + "[0][" + std::to_string(k) + "];\n";
    }
    text += "riis_warp_options_init(&warp_options, sizeof warp_options);\nwarp_options.noise = " +
            shortest(placed.warp_noise) + ";\nwarp_options.placement = &options;\n" +
            "riis_warp_create(&sources, &warp_options, &warp);\nriis_warp_set_targets(warp, &targets);\n" +
            "riis_valve_set_warp(valve, warp, NULL);\nriis_warp_destroy(&warp);\n";
  }
  return text + "riis_surface_create(valve, &options, &surface);\n";
}

// A double as Fortran writes it: 1.5d0.
std::string in_fortran(double number) {
  std::string text = shortest(number);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text + "d0";
  text[e] = 'd';
  return text;
}

std::string fortran_of(const Placed &placed) {
  const riis_placement &at = placed.placement;
  std::string text = "call valve%create('" + placed.kind + "')\n";
  for (const Size &size : placed.sizes) {
    if (!is_changed(size)) continue;
    const std::string values = numbers_text(size.values.data(), size.values.size(), ", ", in_fortran);
    text += "call valve%set('" + std::string(size.parameter.name) + "', " +
            (size.values.size() == 1 ? values : "[" + values + "]") + ")\n";
  }
  const std::string where = "scale=" + in_fortran(at.scale) + ", &\n  rotation_axis=[" +
                            numbers_text(at.rotation_axis, 3, ", ", in_fortran) +
                            "], &\n  rotation_angle=" + in_fortran(at.rotation_angle) + ", &\n  translation=[" +
                            numbers_text(at.translation, 3, ", ", in_fortran) + "])\n";
  if (placed.is_warped) {
    const auto array = [](const std::vector<double> &xyz) {
      std::string made = "reshape([ &\n";
      for (std::size_t i = 0; i < xyz.size(); i += 3)
        made += "  " + numbers_text(xyz.data() + i, 3, ", ", in_fortran) + (i + 3 < xyz.size() ? ", &\n" : "");
      return made + "], [3, " + std::to_string(xyz.size() / 3) + "])";
    };
    text += "! The warp moves landmarks on the valve to the patient's landmarks.\ncall warp%create(" +
            array(placed.sources) + ", &\n  noise=" + in_fortran(placed.warp_noise) + ", " + where +
            "call warp%set_targets(" + array(placed.targets) + ")\ncall valve%set_warp(warp)\ncall warp%destroy()\n";
  }
  return text + "call surface%create(valve, " + where;
}

}  // namespace

void run_place(const PlaceOptions &options) {
  const OutputLocks locks = check_outputs(options);
  Valve valve;
  const Placed placed = place(options, valve);
  check_mesh(options, placed);
  ValveOptions shape = options;
  shape.valve = placed.kind;
  shape.surface_options = placed.where;
  shape.unit = placed.landmarks.unit;
  check_shape(shape, valve, false);
  const std::string file = placed_file_of(placed, valve);
  // OpenFOAM's lengths are metres.
  const double longest =
      options.skirt ? factor_between(placed.landmarks.unit, Unit::metre) * *options.skirt : longest_foam_skirt;
  const std::pair<std::string, std::string> outputs[] = {
      {options.output, file},
      {options.foam_output,
       options.foam_output.empty() ? "" : foam_valve_of(options.landmarks, Json::parse(file), longest)},
      {options.c_output, c_of(placed)},
      {options.fortran_output, fortran_of(placed)}};
  bool uses_stdout = false;
  for (const auto &[path, text] : outputs) {
    if (path.empty()) continue;
    write_text(path, text);
    uses_stdout = uses_stdout || path == "-";
  }
  if (!options.quiet && !uses_stdout) write_text("-", take_notes() + place_report(placed, Reader::program));
}

}  // namespace riis::program
