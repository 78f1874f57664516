// SPDX-License-Identifier: Apache-2.0
// The input is a patient's case. The result is a folder in which dolfinx runs one beat as it is (docs/patient_fenicsx.md).
#pragma once

#include "program/patient/solver_case.hpp"

namespace riis::program {

// Writes the solver's folder: run.py, its numbers in case.json, and copies of mesh.msh, placed.json and wall.stl. Lengths of the
// case's folder must be in metres. Prints how long the run of a beat takes. Refuses a folder that is not empty.
void write_fenicsx_case(const SolverCase &solver);

}  // namespace riis::program
