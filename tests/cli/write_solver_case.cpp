// SPDX-License-Identifier: Apache-2.0
// write_solver_case svmultiphysics|fenicsx|openfoam CASE.json: writes a solver's folder from the numbers of a SolverCase. The
// program ends as riis does. test_solver_cases.py and test_openfoam_case.py call it.
#include <iostream>
#include <string>

#include "program/base/refusal.hpp"
#include "program/input/json.hpp"
#include "program/patient/solver_case.hpp"

namespace {

using namespace riis::program;

SolverCase case_of(const Json &json) {
  SolverCase solver;
  solver.folder = json.at("folder");
  solver.solver = json.at("solver");
  solver.unit = unit_of(json.at("unit")).value();
  solver.kind = json.at("kind");
  solver.is_mitral = json.at("is_mitral");
  solver.name = json.at("name");
  solver.half_thickness = json.at("half_thickness");
  solver.skirt = json.at("skirt");
  solver.resistance = json.at("resistance");
  solver.starts_closed = json.at("starts_closed");
  if (json.contains("hold")) solver.hold = json.at("hold").get<double>();
  solver.upstream = json.at("upstream");
  solver.downstream = json.at("downstream");
  solver.ball_radius = json.at("ball_radius");
  for (const Json &one : json.at("boundaries")) {
    Boundary boundary;
    boundary.name = one.at("name");
    boundary.group = one.at("group");
    boundary.area = one.at("area");
    solver.boundaries.push_back(boundary);
  }
  solver.n_nodes = json.at("n_nodes");
  solver.n_cells = json.at("n_cells");
  if (json.contains("period")) solver.period = json.at("period");
  if (json.contains("orifice"))
    solver.open_area = OpenArea{json.at("orifice").at(0), json.at("orifice").at(1), json.at("orifice").at(2)};
  return solver;
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 3) return exit_wrong_usage;
  const std::string solver = argv[1];
  try {
    const SolverCase numbers = case_of(parse_json_file(argv[2], "a case"));
    if (solver == "svmultiphysics") write_svmultiphysics_case(numbers);
    if (solver == "fenicsx") write_fenicsx_case(numbers);
    if (solver == "openfoam") write_openfoam_case(numbers);
    return exit_fine;
  } catch (const Refusal &refusal) {
    std::cerr << "riis: " << refusal.text << std::endl;
    return refusal.exit_code;
  }
}
