// SPDX-License-Identifier: Apache-2.0
// The inputs are a mesh with named boundaries of a patient, and a valve that is placed in the mesh. The result is a folder that
// OpenFOAM 1912 runs as it is.
#pragma once

#include "program/patient/solver_case.hpp"

namespace riis::program {

// Writes the folder `solver`: the mesh, the dictionaries, and the scripts Allrun and report.py. An aortic valve is driven by the
// pressure of the ventricle and by a Windkessel. A mitral valve is driven by the pressures of the atrium and the ventricle.
// Refuses a unit that is not metres, a valve that starts open, and a mesh without exactly one inlet, one wall and at least one
// outlet.
void write_openfoam_case(const SolverCase &the);

}  // namespace riis::program
