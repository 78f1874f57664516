// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <variant>

#include "common/xml_text.hpp"
#include "program/base/quantities.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/cli/command_line.hpp"
#include "program/commands/commands.hpp"
#include "program/mark/warnings.hpp"
#include "program/patient/case_files.hpp"

namespace riis::program {
namespace {

constexpr double solver_step = svmultiphysics_cost.step;  // s
constexpr int steps_between_files = 10;                   // seconds_between_files
// The largest edge of the leaflets' triangles, in half thicknesses. With such triangles, the K that the solver computes is
// correct to 5 %. The K that riis computes in the solver is exact (docs/export.md, "How fine the triangles must be"). With finer
// triangles, the solver would need hours.
constexpr double largest_edge = 0.5;
constexpr int n_modes = 128;  // of a curve of pressure, which differs from its polygon by less than 0.5 mmHg

constexpr double dyn_per_cm2 = 10;                                   // in a Pa
constexpr double resistance_in_cgs = 1e-5, compliance_in_cgs = 1e5;  // of a Windkessel, in dyn, cm and s

std::string element(const std::string &name, const std::string &value) {
  return "<" + name + "> " + value + " </" + name + ">";
}

// Returns a pressure curve in the form that the solver reads: a polygon, which the solver approximates by a Fourier series.
std::string temporal_values(const PressureCurve &curve) {
  std::string text = std::to_string(curve.keys.size()) + ' ' + std::to_string(n_modes) + '\n';
  for (const PressureCurve::Key &key : curve.keys)
    text += shortest(key.time) + ' ' + printed("%.6g", mmHg * key.pressure * dyn_per_cm2) + '\n';
  return text;
}

std::string condition(const std::string &face, const std::string &type, const std::string &lines) {
  return "  <Add_BC name=\"" + face + "\">\n    " + element("Type", type) + "\n" + lines + "  </Add_BC>\n";
}
std::string driven(const std::string &face, const std::string &file) {
  return condition(
      face, "Neu",
      "    " + element("Time_dependence", "Unsteady") + "\n    " + element("Temporal_values_file_path", file) + "\n");
}
std::string steady(const std::string &face, const std::string &type, double value) {
  return condition(
      face, type,
      "    " + element("Time_dependence", "Steady") + "\n    " + element("Value", printed("%.6g", value)) + "\n");
}

// Returns the Windkessel of an outlet. Several outlets share the flow of blood in proportion to their areas.
std::string windkessel_of(const Boundary &outlet, double share) {
  const Windkessel body;
  std::string lines = "    " + element("Time_dependence", "RCR") + "\n    <RCR_values>\n";
  for (const auto &[name, value] :
       {std::pair("Proximal_resistance", resistance_in_cgs * body.proximal_resistance / share),
        {"Capacitance", compliance_in_cgs * body.compliance * share},
        {"Distal_resistance", resistance_in_cgs * body.distal_resistance / share},
        {"Distal_pressure", dyn_per_cm2 * body.distal_pressure},
        {"Initial_pressure", dyn_per_cm2 * body.initial_pressure}})
    lines += "      " + element(name, printed("%.6g", value)) + "\n";
  return condition(outlet.name, "Neu", lines + "    </RCR_values>\n");
}

std::string conditions_of(const SolverCase &solver, const Ends &ends) {
  std::string text = steady("wall", "Dir", 0);
  if (solver.is_mitral) {
    text += steady("inlet", "Neu", dyn_per_cm2 * pressure_of_left_atrium);
    for (const Boundary &outlet : ends.outlets) text += driven(outlet.name, "ventricle.dat");
    return text;
  }
  text += driven("inlet", "ventricle.dat");
  for (const Boundary &outlet : ends.outlets) text += windkessel_of(outlet, outlet.area / ends.outlet_area);
  return text;
}

// Parses the words as if the user had typed them, so that the printed command has the same effect.
ExportOptions export_of(std::vector<std::string> words) {
  std::vector<char *> arguments;
  for (std::string &word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const auto request = parse_command_line(static_cast<int>(words.size()), arguments.data());
  return std::get<ExportOptions>(request.value());
}

// Returns the words of the command riis export. `folder` is the path of the case's folder. In the block that riis export prints,
// the paths of the valve's files are relative to the solver's folder.
std::vector<std::string> export_words(const SolverCase &solver, const std::string &folder) {
  std::vector<std::string> words = {"riis", "export", "valve", folder + "/mesh.vtu"};
  const auto add = [&words](const char *option, const std::string &value) {
    words.insert(words.end(), {option, value});
  };
  add("--unit", "cm");
  add("--valve", folder + "/placed.json");
  add("--half-thickness", printed("%.9g", solver.half_thickness));
  add("--resistance", shortest(solver.resistance));
  add("--density", shortest(solver.density));
  add("--viscosity", shortest(solver.viscosity));
  add("--time-step", shortest(solver_step));
  add("--opening-seconds", shortest(motion_seconds));
  add("--closing-seconds", shortest(motion_seconds));
  add("--largest-edge", printed("%.3g", largest_edge * solver.half_thickness));
  add("--name", solver.name);
  add("--starts", solver.starts_closed ? "closed" : "open");
  if (solver.skirt > 0) {
    add("--skirt", printed("%.9g", solver.skirt));
    add("--wall", folder + "/wall.stl");
  }
  return words;
}

std::string write_valve(const SolverCase &solver) {
  print_line("cd " + shell_word(solver.solver) + " && " + shell_text(export_words(solver, "..")));
  ExportOptions options = export_of(export_words(solver, solver.folder));
  const std::string named = options.folder;
  options.folder = solver.solver + "/" + named;
  const UrisExport valve = write_uris(options, named);
  if (!valve.failure.empty()) refuse_data(valve.failure);
  return valve.block;
}

std::string faces_of(const SolverCase &solver) {
  std::string text;
  for (const Boundary &boundary : solver.boundaries) {
    const std::string file = "mesh-complete/mesh-surfaces/" + boundary.name + ".vtp";
    copy_into(solver, "faces/" + boundary.name + ".vtp", file);
    text += "  <Add_face name=\"" + boundary.name + "\">\n    " + element("Face_file_path", file) + "\n  </Add_face>\n";
  }
  return text;
}

}  // namespace

void write_svmultiphysics_case(const SolverCase &solver) {
  const Ends ends = ends_of(solver, Unit::centimetre);
  make_case_folder(solver);
  copy_into(solver, "mesh.vtu", "mesh-complete/mesh-complete.mesh.vtu");
  const std::string faces = faces_of(solver), valve = write_valve(solver);
  write_into(solver, "ventricle.dat",
             temporal_values(solver.is_mitral ? pressure_of_filling_ventricle(solver.period)
                                              : pressure_of_left_ventricle(solver.period)));
  const int n_steps = static_cast<int>(solver.period / solver_step + 0.5);
  write_into(solver, "solver.xml",
             filled(case_texts().at("svmultiphysics/solver.xml"),
                    {{"TITLE", "One beat of a " + in_xml(solver.kind) + " valve, written by riis patient."},
                     {"STEPS", std::to_string(n_steps)},
                     {"TIME_STEP", shortest(solver_step)},
                     {"SAVE", std::to_string(steps_between_files)},
                     {"FACES", faces},
                     {"VALVE", valve},
                     {"DENSITY", printed("%.6g", solver.density * factor_from_si(a_density, Unit::centimetre))},
                     {"VISCOSITY", printed("%.6g", solver.viscosity * factor_from_si(a_viscosity, Unit::centimetre))},
                     {"CONDITIONS", conditions_of(solver, ends)}}));
  write_scripts(solver, "svmultiphysics", "Allrun");
  announce_beat(solver, svmultiphysics_cost);
}

}  // namespace riis::program
