// SPDX-License-Identifier: Apache-2.0
// In: a patient's case. Out: a folder in which dolfinx runs one beat without changes (docs/patient_fenicsx.md).
#pragma once

#include "program/patient/solver_case.hpp"

namespace riis::program {

// Writes the solver's folder: run.py, case.json with its numbers, and copies of mesh.msh, placed.json and wall.stl of the case's
// folder, which has metres. Prints how long a beat takes. Refuses a folder that is not empty.
void write_fenicsx_case(const SolverCase &solver);

}  // namespace riis::program
