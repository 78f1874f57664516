// SPDX-License-Identifier: Apache-2.0
// In: a patient's mesh with named boundaries, and a valve that is placed in the mesh. Out: a folder in which a flow solver can
// run without changes. riis patient fills a SolverCase. For each solver, one function writes this solver's folder from the
// SolverCase.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/base/units.hpp"

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
};

}  // namespace riis::program
