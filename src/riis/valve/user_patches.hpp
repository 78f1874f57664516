// SPDX-License-Identifier: Apache-2.0
// The caller's own valve. It is given by boundary curves with control points, and by patches with four sides.
// In: arrays as in riis_patches, which this file checks completely. Out: a patch set, and the kind of valves made of patches.
#pragma once

#include <riis/riis.h>

#include "valve/valve.hpp"

namespace riis {

// Makes a patch set from the caller's arrays. Fails with RIIS_INVALID_ARGUMENT for bad fields, and with RIIS_INVALID_PARAMETER
// for bad curves and patches. The message names the field, the curve or patch, and the value.
PatchSet patches_from_arrays(const riis_patches &arrays);

const ValveKind &patches_valve_kind();

}  // namespace riis
