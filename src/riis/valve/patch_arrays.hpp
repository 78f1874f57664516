// SPDX-License-Identifier: Apache-2.0
// The patches of a valve in arrays, as callers read them.
// In: patches. Out: arrays in the layout of riis_valve_patches.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

#include "valve/patches.hpp"

namespace riis {

struct PatchArrays {
  std::vector<std::int64_t> first_span;
  std::vector<std::int32_t> degree, curve_id, reversed, leaflet_id, patch_id, attached;
  std::vector<double> control, bulge;
};

// Every image becomes a patch of its own. Patches that point upstream are exchanged at u, so that S_u x S_v points downstream.
PatchArrays arrays_of(const PatchSet &set);
// Returns pointers to the arrays, which are valid as long as the arrays.
riis_valve_patches view_of(const PatchArrays &arrays);

}  // namespace riis
