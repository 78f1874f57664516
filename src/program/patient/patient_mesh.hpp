// SPDX-License-Identifier: Apache-2.0
// The inputs are a wall with named ends, and a size field of riis size-field. The result is a volume mesh with named boundaries,
// in the files that solvers read. gmsh makes the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "program/base/options.hpp"
#include "program/patient/flat_ends.hpp"
#include "program/patient/solver_case.hpp"

namespace riis::program {

struct PatientMeshOptions {
  std::string folder;       // which exists; the files go here
  std::string field;        // the file of riis size-field
  double largest_edge = 0;  // edge length outside the field's grid: --largest-edge of riis size-field
  // The function that is called with each command before the command runs. Its argument is the command as a user would type it.
  std::function<void(const std::string &command)> announce = [](const std::string &) {};
  double surface_seconds = 0;  // the time that gmsh has for the surface; 0: by the number of triangles
};

struct PatientMesh {
  std::vector<Boundary> boundaries;  // the inlet, the outlets, the wall
  std::int64_t n_nodes = 0, n_cells = 0;
  double volume = 0;                 // of all cells
  double longest_edge = 0;           // of all cells
  double least_quality = 0;          // of all cells: 3 times the radius of the inner sphere over that of the outer one
  std::vector<std::string> written;  // paths of the files
};

// Throws a Refusal if there is no gmsh in PATH. The message says which package to install. Returns gmsh's version.
std::string require_gmsh();

// Makes the mesh. First gmsh remeshes the surface with the edge lengths of the size field, and keeps the rims of the ends. Then
// gmsh fills the remeshed surface with tetrahedra. Every end must have a name. Writes into `folder`
//   mesh.msh        ASCII gmsh 2.2: physical groups of the boundaries, and "blood" of the tetrahedra
//   mesh.vtu        the tetrahedra, with GlobalNodeID and GlobalElementID
//   faces/NAME.vtp  the triangles of a boundary, outwards, with GlobalNodeID, GlobalElementID and ModelFaceID
//   gmsh/           what gmsh reads, and its logs
// If gmsh fails, the refusal has gmsh's last message and its log. Also refuses a mesh that is not closed or has lost an end.
PatientMesh mesh_patient(const PatientWall &wall, const PatientMeshOptions &options);

// The input is a mesh with a placed valve. The results are a point in the blood upstream of the valve, a point downstream, and
// the side of the valve on which each end lies.
struct ValveSides {
  std::array<double, 3> upstream{}, downstream{};
  double ball_radius = 0;  // of balls around the two points that meet neither the wall nor the band at any opening
  bool are_apart = false;  // whether the closed valve parts the unmarked nodes on its two sides
  std::vector<std::string> before, after;  // the ends on either side, if the sides are apart
};

// `marking` has the options of the valve, with its skirt and its half thickness. `centre` is the middle of the annulus, and
// `flow` is the direction of the blood. `millimetre` is the length of a millimetre in the mesh's unit. Refuses a mesh that has no
// room for the two points.
ValveSides sides_of_valve(const std::string &mesh, const MarkOptions &marking, const std::vector<Boundary> &boundaries,
                          const std::array<double, 3> &centre, const std::array<double, 3> &flow, double millimetre);

}  // namespace riis::program
