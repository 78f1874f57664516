// SPDX-License-Identifier: Apache-2.0
// The caller's own valve: boundary curves by control points, patches by their four sides.
// In: arrays as in riis_patches, checked here in full. Out: a patch set, and the kind of valve that is made of one.
#pragma once

#include <riis/riis.h>

#include "valve/valve.hpp"

namespace riis {

// Fails with RIIS_INVALID_ARGUMENT, or RIIS_INVALID_PARAMETER for curves and patches that are none, naming the field, the
// curve or patch, and the value.
PatchSet patches_from_arrays(const riis_patches &arrays);

const ValveKind &patches_valve_kind();

}  // namespace riis
