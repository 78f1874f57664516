// SPDX-License-Identifier: Apache-2.0
// The caller's own valve, given by boundary curves with control points, and by patches with four sides. This file checks the
// arrays of riis_patches completely, and makes a patch set. This file also has the kind for valves from patches.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "valve/patches.hpp"
#include "valve/valve.hpp"

namespace riis {

// Makes a patch set from the caller's arrays. Fails with RIIS_INVALID_ARGUMENT for bad fields, and with RIIS_INVALID_PARAMETER
// for bad curves and patches. The message names the field, the curve or patch, and the value.
PatchSet patches_from_arrays(const riis_patches &arrays);

const ValveKind &patches_valve_kind();

// The patches of a valve, in arrays that callers read.
// The arrays have the layout of riis_valve_patches.
struct PatchArrays {
  std::vector<std::int64_t> first_span;
  std::vector<std::int32_t> degree, curve_id, reversed, leaflet_id, patch_id, attached;
  std::vector<double> control, bulge;
};

// Every image becomes a separate patch. If a patch points upstream, its u is reversed, so that S_u x S_v points downstream.
PatchArrays arrays_of(const PatchSet &set);
// Returns pointers to the arrays. The pointers are valid as long as the arrays exist.
riis_valve_patches view_of(const PatchArrays &arrays);

}  // namespace riis
