// SPDX-License-Identifier: Apache-2.0
#include "program/patient/openfoam_case.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/json.hpp"
#include "program/output/outputs.hpp"
#include "program/patient/heartbeat.hpp"
#include "program/patient/openfoam_valve.hpp"

namespace riis::program {
namespace {

namespace fs = std::filesystem;

// The name of something in the case, and its text.
using FoamValues = std::vector<std::pair<std::string, std::string>>;

std::string with_foam_values(std::string text, const FoamValues &values) {
  for (const auto &[name, value] : values) {
    const std::string mark = "@" + name + "@";
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
      text.replace(at, mark.size(), value);
  }
  return text;
}

std::string foam_point_of(const std::array<double, 3> &point) { return "(" + numbers_text(point.data(), 3, " ") + ")"; }

// Returns the text with four more levels of spaces before each line.
std::string foam_indented(const std::string &text) {
  std::string made;
  for (const std::string &line : split(text, "\n"))
    if (!line.empty()) made += "    " + line + "\n";
  return made;
}

// The boundaries of the case by their roles.
struct FoamEnds {
  const Boundary *inlet = nullptr;
  std::vector<const Boundary *> outlets;
};

FoamEnds foam_ends_of(const SolverCase &the) {
  FoamEnds ends;
  bool has_wall = false;
  for (const Boundary &boundary : the.boundaries) {
    if (boundary.name == "inlet") ends.inlet = &boundary;
    if (boundary.name == "wall") has_wall = true;
    if (boundary.name.rfind("outlet", 0) == 0) ends.outlets.push_back(&boundary);
  }
  const std::size_t known = ends.outlets.size() + (ends.inlet ? 1 : 0) + (has_wall ? 1 : 0);
  if (!ends.inlet || ends.outlets.empty() || !has_wall || known != the.boundaries.size()) {
    std::vector<std::string> names;
    for (const Boundary &boundary : the.boundaries) names.push_back(boundary.name);
    refuse_data("--solver openfoam: the boundaries are " + joined_by(names, ", ") +
                "; they must be inlet, wall, and outlet, outlet_2 and so on");
  }
  return ends;
}

// The entries of 0/p for the ends, and the pressure at which the case begins.
struct FoamPressures {
  std::string patches;
  double start;
};

class FoamPressureWriter {
 public:
  explicit FoamPressureWriter(double density) : density_(density) {}

  // The kinematic pressure of a pressure in Pa.
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

  // The arteries behind an outlet with this share of the area of all outlets.
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

FoamPressures foam_pressures_of(const SolverCase &the, const FoamEnds &ends) {
  const FoamPressureWriter writer(the.density);
  FoamPressures made;
  if (the.is_mitral) {
    made.start = writer.kinematic(pressure_of_filling_ventricle().at(0));
    made.patches = writer.constant("inlet", "The atrium", pressure_of_left_atrium);
    for (const Boundary *outlet : ends.outlets)
      made.patches += writer.curve(outlet->name, "The ventricle", pressure_of_filling_ventricle());
    return made;
  }
  made.start = writer.kinematic(pressure_of_left_ventricle().at(0));
  made.patches = writer.curve("inlet", "The ventricle", pressure_of_left_ventricle());
  double area = 0;
  for (const Boundary *outlet : ends.outlets) area += outlet->area;
  for (const Boundary *outlet : ends.outlets) made.patches += writer.arteries(outlet->name, outlet->area / area);
  return made;
}

// The function objects that sum the flow through each end.
std::string foam_flows_of(const FoamEnds &ends) {
  std::string text =
      "    flow_inlet // postProcessing/flow_inlet/TIME/surfaceFieldValue.dat: the flow out of the blood [m3/s]\n    "
      "{\n"
      "        type surfaceFieldValue;\n        libs (fieldFunctionObjects);\n        regionType patch;\n"
      "        name inlet;\n        operation sum;\n        fields (phi);\n        writeFields no;\n        log no;\n"
      "        writePrecision 12;\n    }\n";
  for (const Boundary *outlet : ends.outlets)
    text += "    flow_" + outlet->name + " { $flow_inlet; name " + outlet->name + "; }\n";
  return text;
}

}  // namespace

void write_openfoam_case(const SolverCase &the) {
  if (the.unit != Unit::metre)
    refuse_data(std::string("--solver openfoam: the mesh is in ") + words_of(the.unit) + "; OpenFOAM takes metres");
  if (!the.starts_closed) refuse_data("--solver openfoam: the valve's law, switch, starts with a closed valve");
  const FoamEnds ends = foam_ends_of(the);
  const FoamPressures pressures = foam_pressures_of(the, ends);
  const std::string placed = (fs::path(the.folder) / "placed.json").string();
  const std::string valve = foam_valve_of(placed, parse_json_file(placed, "a placed valve"), the.skirt);
  // The backflow of a mitral valve in a rigid ventricle is larger, so this valve begins to close before the flow reverses.
  const FoamValues values = {{"NAME", the.name},
                             {"DENSITY", shortest(the.density)},
                             {"RESISTANCE", shortest(the.resistance)},
                             {"HALF_THICKNESS", shortest(the.half_thickness)},
                             {"KINEMATIC_VISCOSITY", printed("%.6g", the.viscosity / the.density)},
                             {"MMHG", printed("%.6g", mmHg / the.density)},
                             {"CLOSE_BELOW", the.is_mitral ? "1e-4" : "0"},
                             {"PERIOD", shortest(beat_period)},
                             {"MOTION_SECONDS", shortest(motion_seconds)},
                             {"OPEN_ABOVE", shortest(opening_pressure)},
                             {"UPSTREAM", foam_point_of(the.upstream)},
                             {"DOWNSTREAM", foam_point_of(the.downstream)},
                             {"RADIUS", shortest(the.ball_radius)},
                             {"START", printed("%.6g", pressures.start)},
                             {"PATCHES", pressures.patches},
                             {"FLOWS", foam_flows_of(ends)},
                             {"VALVE", foam_indented(valve)}};
  const fs::path folder = the.solver;
  std::error_code error;
  for (const char *const part : {"0", "constant", "system"}) fs::create_directories(folder / part, error);
  for (const FoamFile &file : foam_files)
    write_text((folder / file.path).string(), with_foam_values(file.text, values));
  fs::permissions(folder / "Allrun", fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                  fs::perm_options::add, error);
  fs::copy_file(fs::path(the.folder) / "mesh.msh", folder / "mesh.msh", fs::copy_options::overwrite_existing, error);
  if (error)
    refuse_data((folder / "mesh.msh").string() + ": " + (fs::path(the.folder) / "mesh.msh").string() +
                " could not be copied: " + error.message());
}

}  // namespace riis::program
