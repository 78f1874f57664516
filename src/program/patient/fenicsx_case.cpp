// SPDX-License-Identifier: Apache-2.0
#include "program/base/text.hpp"
#include "program/input/json.hpp"
#include "program/mark/warnings.hpp"
#include "program/patient/case_files.hpp"

namespace riis::program {
namespace {

Json keys_of(const PressureCurve &curve) {
  Json keys = Json::array();
  for (const PressureCurve::Key &key : curve.keys) keys.push_back({key.time, mmHg * key.pressure});
  return keys;
}

Json constant(double pressure, double period) { return {{0, pressure}, {period, pressure}}; }

Json numbers_of(const SolverCase &solver, const Ends &ends) {
  Json boundaries = Json::object(), pressures = Json::object(), windkessels = Json::object();
  for (const Boundary &boundary : solver.boundaries) boundaries[boundary.name] = boundary.group;
  pressures["inlet"] = solver.is_mitral ? constant(pressure_of_left_atrium, solver.period)
                                        : keys_of(pressure_of_left_ventricle(solver.period));
  const Windkessel body;
  for (const Boundary &outlet : ends.outlets) {
    if (solver.is_mitral) {
      pressures[outlet.name] = keys_of(pressure_of_filling_ventricle(solver.period));
      continue;
    }
    // Several outlets share the flow of blood in proportion to their areas.
    const double share = outlet.area / ends.outlet_area;
    windkessels[outlet.name] = {{"numbers",
                                 {body.proximal_resistance / share, body.distal_resistance / share,
                                  body.compliance * share, body.distal_pressure}},
                                {"pressure", body.initial_pressure}};
  }
  return {{"valve", solver.kind},
          {"unit", name_of(solver.unit)},
          {"half_thickness", solver.half_thickness},
          {"skirt", solver.skirt},
          {"resistance", solver.resistance},
          {"density", solver.density},
          {"viscosity", solver.viscosity},
          {"starts_closed", solver.starts_closed},
          {"upstream", solver.upstream},
          {"downstream", solver.downstream},
          {"ball_radius", solver.ball_radius},
          {"boundaries", boundaries},
          {"pressures", pressures},
          {"windkessels", windkessels},
          {"law",
           {{"opening_duration", motion_seconds},
            {"closing_duration", motion_seconds},
            {"open_above", opening_pressure},
            {"close_below", solver.is_mitral ? closing_flow_of_mitral : 0.0},
            {"filter_time", 0.002},
            {"dwell_time", dwell_seconds}}},
          {"period", solver.period},
          {"time_step", dolfinx_cost.step},
          {"steps", static_cast<int>(solver.period / dolfinx_cost.step + 0.5)}};
}

}  // namespace

void write_fenicsx_case(const SolverCase &solver) {
  const Ends ends = ends_of(solver, Unit::metre);
  make_case_folder(solver);
  for (const char *name : {"mesh.msh", "placed.json", "wall.stl"})
    if (solver.skirt > 0 || name != std::string("wall.stl")) copy_into(solver, name, name);
  write_into(solver, "case.json", numbers_of(solver, ends).dump(1) + "\n");
  write_scripts(solver, "fenicsx", "run.py");
  announce_beat(solver, dolfinx_cost);
}

}  // namespace riis::program
