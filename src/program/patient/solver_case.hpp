// SPDX-License-Identifier: Apache-2.0
// The inputs are a patient's mesh with named boundaries, and a valve that is placed in the mesh. The result is a folder in which
// a flow solver can run without changes. riis patient fills a SolverCase. For each solver, one function writes this solver's
// folder from the SolverCase. Each folder must be new or empty, and the case must have one inlet, one wall and at least one
// outlet.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/base/units.hpp"
#include "program/input/json.hpp"

namespace riis::program {

// A named part of the mesh's boundary, with lengths in the mesh's unit.
struct Boundary {
  std::string name;                 // "inlet", "outlet", "outlet_2", ... or "wall"
  std::int32_t group = 0;           // number of its physical group in mesh.msh
  std::array<double, 3> centre{};   // of its area
  std::array<double, 3> outward{};  // mean unit normal, out of the blood; of an end only
  double area = 0;
  std::int64_t n_faces = 0;
};

// The fully open valve: the area between its leaflets, the part that the band leaves open, and advice if this part is small.
// Areas are in m2.
struct OpenArea {
  double orifice = 0, free = 0;
  std::string cure;
};

// The data that every solver needs. Lengths are in the mesh's unit. R, density and viscosity are in SI units.
struct SolverCase {
  std::string folder;       // of riis patient: mesh.msh, faces/NAME.vtp, wall.stl and placed.json lie here
  std::string solver;       // the solver's own folder, inside of `folder`
  Unit unit = Unit::metre;  // of the mesh: metres for OpenFOAM and FEniCSx, centimetres for svMultiPhysics
  std::string kind;         // of the valve
  bool is_mitral =
      false;         // the blood fills a ventricle: atrial pressure at the inlet, the ventricle's at the other end
  std::string name;  // of the valve in the solver, such as "aortic_valve"

  double half_thickness = 0;                  // eps
  double skirt = 0;                           // the longest skirt that is accepted; with the wall it ends at the wall
  double resistance = 1e4;                    // R, kg/(m s)
  double density = 1060, viscosity = 3.5e-3;  // of blood, kg/m3 and Pa s
  bool starts_closed = true;
  std::optional<double> hold{};  // the opening at which the valve is held; nothing: the blood moves the valve
  std::array<double, 3> upstream{},
      downstream{};                  // points in the blood before and after the valve, and the radius of balls
  double ball_radius = 0;            // of the balls around these points, in which pressures are read
  std::vector<Boundary> boundaries;  // the inlet, the outlets, the wall
  std::int64_t n_nodes = 0, n_cells = 0;
  double band_edge = 0;  // edge length in the band
  double period = 0.8;   // of a beat [s], a multiple of the time between two files
  std::optional<OpenArea> open_area{};
};

// Writes a folder that OpenFOAM 1912 runs as it is: the mesh, the dictionaries, and the scripts Allrun and report.py. An aortic
// valve is driven by the pressure of the ventricle and by a Windkessel. A mitral valve is driven by the pressures of the atrium
// and the ventricle. Refuses a unit that is not metres, and a valve that starts open.
void write_openfoam_case(const SolverCase &the);

// Writes a folder in which svMultiPhysics runs one beat as it is (docs/patient_svmultiphysics.md). The folder has the mesh with
// its faces, the valve's motion, pressures, solver.xml and Allrun. Reads mesh.vtu, faces/NAME.vtp, placed.json and wall.stl from
// the case's folder, with lengths in centimetres. Prints the command of the export, and how long the run of a beat takes.
void write_svmultiphysics_case(const SolverCase &solver);

// Writes a folder in which dolfinx runs one beat as it is (docs/patient_fenicsx.md). The folder has run.py, its numbers in
// case.json, and copies of mesh.msh, placed.json and wall.stl. Lengths of the case's folder must be in metres. Prints how long
// the run of a beat takes.
void write_fenicsx_case(const SolverCase &solver);

// The longest skirt that OpenFOAM accepts by default, in metres. Gaps in patients are below 3 mm, and the walls of other chambers
// are farther away.
inline constexpr double longest_foam_skirt = 6e-3;
// Returns the entries valve, placement, warp and skirt of OpenFOAM's dictionary of riisValve (examples/openfoam/README.md).
// `root` is the content of the file of a placed valve. `longest` is the length of the longest skirt in metres, or 0 for no skirt.
// The skirt ends at the patch `wall` of the mesh. A valve whose parameter skirt_length is set keeps its own skirt. A kind of
// valve that cannot have a skirt gets none. Refuses a warp that changes in time.
std::string foam_valve_of(const std::string &path, const Json &root, double longest);

}  // namespace riis::program
