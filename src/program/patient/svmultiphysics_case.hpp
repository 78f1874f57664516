// SPDX-License-Identifier: Apache-2.0
// The input is a patient's case. The result is a folder in which svMultiPhysics runs one beat as it is
// (docs/patient_svmultiphysics.md).
#pragma once

#include "program/patient/solver_case.hpp"

namespace riis::program {

// Writes the solver's folder: the mesh with its faces, the valve's motion, pressures, solver.xml and Allrun. Reads mesh.vtu,
// faces/NAME.vtp, placed.json and wall.stl from the case's folder, with lengths in centimetres. Prints the command of the export,
// and how long the run of a beat takes. Refuses a folder that is not empty.
void write_svmultiphysics_case(const SolverCase &solver);

}  // namespace riis::program
