// SPDX-License-Identifier: Apache-2.0
// write_openfoam_case FOLDER CASE.json: fills a SolverCase from a file and writes the case, for test_openfoam_case.py and for
// ./run openfoam patient.
#include <fstream>
#include <iostream>
#include <string>

#include "program/base/refusal.hpp"
#include "program/input/json.hpp"
#include "program/patient/openfoam_case.hpp"

int main(int argc, char **argv) {
  using namespace riis::program;
  if (argc != 3) return 2;
  try {
    const Json root = parse_json_file(argv[2], "a case");
    SolverCase the;
    the.folder = argv[1];
    the.solver = the.folder + "/openfoam";
    the.unit = *unit_of(root.value("unit", "m"));
    the.kind = root.value("kind", "coapting");
    the.is_mitral = root.value("is_mitral", false);
    the.name = root.value("name", "aortic_valve");
    the.half_thickness = root.value("half_thickness", 1e-3);
    the.skirt = root.value("skirt", 6e-3);
    the.resistance = root.value("resistance", the.resistance);
    the.starts_closed = root.value("starts_closed", true);
    the.upstream = root.at("upstream").get<std::array<double, 3>>();
    the.downstream = root.at("downstream").get<std::array<double, 3>>();
    the.ball_radius = root.value("ball_radius", 4e-3);
    for (const Json &one : root.at("boundaries")) {
      Boundary boundary;
      boundary.name = one.at("name").get<std::string>();
      boundary.area = one.value("area", 0.0);
      the.boundaries.push_back(boundary);
    }
    write_openfoam_case(the);
  } catch (const Refusal &refusal) {
    std::cerr << refusal.text << '\n';
    return refusal.exit_code;
  }
  return 0;
}
