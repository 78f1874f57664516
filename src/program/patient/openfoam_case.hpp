// SPDX-License-Identifier: Apache-2.0
// In: a patient's mesh with named boundaries, and the valve that is placed in it. Out: a folder that OpenFOAM 1912 runs as it is.
#pragma once

#include "program/patient/solver_case.hpp"

namespace riis::program {

// Writes the folder `solver`: the mesh, the dictionaries, and the scripts Allrun and report.py. The pressure of the ventricle and
// a Windkessel drive an aortic valve. The pressures of the atrium and of the ventricle drive a mitral valve. Refuses another unit
// than metres, a valve that starts open, and boundaries other than one inlet, outlets and a wall.
void write_openfoam_case(const SolverCase &the);

}  // namespace riis::program
