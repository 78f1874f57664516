// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "program/base/handles.hpp"
#include "program/base/refusal.hpp"
#include "program/base/system.hpp"
#include "program/base/text.hpp"
#include "program/input/parameters.hpp"
#include "program/input/valve_source.hpp"
#include "program/input/warp_source.hpp"
#include "program/patient/case_files.hpp"

namespace riis::program {
namespace {

namespace fs = std::filesystem;

// The path of each file of the case, and the key of its text in case_texts.
constexpr std::pair<const char *, const char *> foam_files[] = {
    {"0/U", "openfoam/U"},
    {"0/p", "openfoam/p"},
    {"constant/transportProperties", "openfoam/transportProperties"},
    {"constant/turbulenceProperties", "openfoam/turbulenceProperties"},
    {"system/controlDict", "openfoam/controlDict"},
    {"system/decomposeParDict", "openfoam/decomposeParDict"},
    {"system/fvOptions", "openfoam/fvOptions"},
    {"system/fvSchemes", "openfoam/fvSchemes"},
    {"system/fvSolution", "openfoam/fvSolution"},
    {"Allrun", "openfoam/Allrun"},
    {"report.py", "openfoam/report.py"},
    {"beat_table.py", "beat_table.py"}};

std::string point_of(const std::array<double, 3> &point) { return "(" + numbers_text(point.data(), 3, " ") + ")"; }

// Returns the text with four more spaces at the beginning of each line.
std::string indented(const std::string &text) {
  std::string made;
  for (const std::string &line : split(text, "\n"))
    if (!line.empty()) made += "    " + line + "\n";
  return made;
}

// The entries of the ends in 0/p, and the pressure at the beginning of the run.
struct Pressures {
  std::string patches;
  double start;
};

class PressureWriter {
 public:
  explicit PressureWriter(double density) : density_(density) {}

  // Returns the kinematic pressure for a pressure in Pa.
  double kinematic(double pressure) const { return pressure / density_; }

  std::string curve(const std::string &name, const char *what, const PressureCurve &curve) const {
    std::string rows, shown;
    for (const auto &[time, pressure] : curve.keys) {
      rows += std::string(rows.empty() ? "" : " ") + "(" + shortest(time) + " " + number(mmHg * pressure) + ")";
      shown += (shown.empty() ? "" : ", ") + shortest(pressure) + " at " + shortest(time) + " s";
    }
    return "    // " + std::string(what) + " [mmHg]: " + shown + ".\n    " + name +
           "\n    {\n        type uniformTotalPressure;\n        p0 table (" + rows +
           ");\n        outOfBounds repeat;\n        value uniform " + number(curve.at(0)) + ";\n    }\n";
  }

  std::string constant(const std::string &name, const char *what, double pressure) const {
    return "    // " + std::string(what) + ": " + printed("%.4g", pressure / mmHg) + " mmHg.\n    " + name +
           "\n    {\n        type uniformTotalPressure;\n        p0 constant " + number(pressure) +
           ";\n        value uniform " + number(pressure) + ";\n    }\n";
  }

  // Returns the arteries behind an outlet. `share` is the outlet's share of the area of all outlets.
  std::string arteries(const std::string &name, double share) const {
    const auto entry = [](const char *key, double value) {
      return "        " + std::string(key) + " " + printed("%.6g", value) + ";\n";
    };
    const Windkessel body;
    return "    // The arteries: two resistances [Pa s/m3], a compliance [m3/Pa] and its pressure [Pa].\n    " + name +
           "\n    {\n        type riisWindkessel;\n" + entry("rho", density_) +
           entry("proximalResistance", body.proximal_resistance / share) +
           entry("distalResistance", body.distal_resistance / share) + entry("compliance", body.compliance * share) +
           entry("venousPressure", body.distal_pressure) + entry("pressure", body.initial_pressure) + "    }\n";
  }

 private:
  std::string number(double pressure) const { return printed("%.6g", kinematic(pressure)); }

  double density_;
};

Pressures pressures_of(const SolverCase &the, const Ends &ends) {
  const PressureWriter writer(the.density);
  Pressures made;
  if (the.is_mitral) {
    made.start = writer.kinematic(pressure_of_filling_ventricle(the.period).at(0));
    made.patches = writer.constant("inlet", "The atrium", pressure_of_left_atrium);
    for (const Boundary &outlet : ends.outlets)
      made.patches += writer.curve(outlet.name, "The ventricle", pressure_of_filling_ventricle(the.period));
    return made;
  }
  made.start = writer.kinematic(pressure_of_left_ventricle(the.period).at(0));
  made.patches = writer.curve("inlet", "The ventricle", pressure_of_left_ventricle(the.period));
  for (const Boundary &outlet : ends.outlets)
    made.patches += writer.arteries(outlet.name, outlet.area / ends.outlet_area);
  return made;
}

// Returns the function objects that add up the flow through each end. For an aortic valve, one more object has the pressure
// behind the valve.
std::string flows_of(const Ends &ends, bool is_mitral) {
  std::string text =
      "    flow_inlet // postProcessing/flow_inlet/TIME/surfaceFieldValue.dat: the flow out of the blood [m3/s]\n    "
      "{\n"
      "        type surfaceFieldValue;\n        libs (fieldFunctionObjects);\n        regionType patch;\n"
      "        name inlet;\n        operation sum;\n        fields (phi);\n        writeFields no;\n        log no;\n"
      "        writePrecision 12;\n    }\n";
  for (const Boundary &outlet : ends.outlets)
    text += "    flow_" + outlet.name + " { $flow_inlet; name " + outlet.name + "; }\n";
  if (!is_mitral)
    text +=
        "    pressure_outlet // the mean pressure in the aorta, over the density\n"
        "    { $flow_inlet; name outlet; operation areaAverage; fields (p); }\n";
  return text;
}

}  // namespace

void write_openfoam_case(const SolverCase &the) {
  if (!the.starts_closed)
    refuse_data(
        "--solver openfoam: the case uses the law switch, which starts with a closed valve, but this valve starts "
        "open");
  const Ends ends = ends_of(the, Unit::metre);
  const Pressures pressures = pressures_of(the, ends);
  const std::string placed = (fs::path(the.folder) / "placed.json").string();
  const std::string valve = foam_valve_of(placed, parse_json_file(placed, "a placed valve"), the.skirt);
  // No pressure reaches 1e9. If the user holds the valve at an opening, the law therefore never opens it.
  const std::string never = "1e9; // never\n        closed ";
  // In a rigid ventricle, much blood flows back through a mitral valve. A mitral valve therefore begins to close before the flow
  // reverses.
  const std::map<std::string, std::string> values = {
      {"NAME", the.name},
      {"DENSITY", shortest(the.density)},
      {"RESISTANCE", shortest(the.resistance)},
      {"HALF_THICKNESS", shortest(the.half_thickness)},
      {"KINEMATIC_VISCOSITY", printed("%.6g", the.viscosity / the.density)},
      {"MMHG", printed("%.6g", mmHg / the.density)},
      {"CLOSE_BELOW", shortest(the.is_mitral ? closing_flow_of_mitral : 0)},
      {"PERIOD", shortest(the.period)},
      {"TIME_STEP", shortest(openfoam_cost.step)},
      {"WRITE_INTERVAL", shortest(seconds_between_files)},
      {"SECONDS_PER_CELL", shortest(openfoam_cost.seconds)},
      {"MOTION_SECONDS", shortest(motion_seconds)},
      {"DWELL_SECONDS", shortest(dwell_seconds)},
      {"OPEN_ABOVE", the.hold ? never + shortest(*the.hold) : shortest(opening_pressure)},
      {"UPSTREAM", point_of(the.upstream)},
      {"DOWNSTREAM", point_of(the.downstream)},
      {"RADIUS", shortest(the.ball_radius)},
      {"START", printed("%.6g", pressures.start)},
      {"PATCHES", pressures.patches},
      {"FLOWS", flows_of(ends, the.is_mitral)},
      {"SKIRT", shortest(the.skirt)},
      {"PROGRAM", shell_text({path_of_this_program()})},
      {"VALVE", indented(valve)}};
  make_case_folder(the);
  for (const auto &[path, file] : foam_files) write_into(the, path, filled(case_texts().at(file), values));
  make_runnable(the, "Allrun");
  write_orifice(the);
  for (const char *const name : {"mesh.msh", "placed.json", "wall.stl"}) copy_into(the, name, name);
}

// ---- The entries of the valve ----

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
    refuse_data(path + ": the warp moves, but OpenFOAM's dictionary takes only a warp that rests or follows the mesh");
  if (!warp.is_in_mesh())
    refuse_data(
        path + ": the warp's landmarks are in the valve's coordinates, but OpenFOAM needs the coordinates of the mesh");
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
    // A parameter is left out if it follows from another parameter, or if it has its default.
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
