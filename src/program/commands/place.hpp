// SPDX-License-Identifier: Apache-2.0
// riis place. In: landmarks of a patient. Out: the sizes and the placement of the valve, as a report, as a file that every
// command takes, and as text for OpenFOAM, C and Fortran.
#pragma once

#include "program/base/options.hpp"

namespace riis::program {

void run_place(const PlaceOptions &options);

}  // namespace riis::program
