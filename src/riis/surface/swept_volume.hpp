// SPDX-License-Identifier: Apache-2.0
// Computes the volume that a surface sweeps. The volume is the integral of u . n over the surface and time, so motion along the
// normals counts as positive.
// In: a valve and two openings. Out: the volume of each leaflet.
#pragma once

#include <cstdint>
#include <map>

#include "valve/valve.hpp"

namespace riis {

// Maps a leaflet_id to the volume that the leaflet sweeps. No placement is applied to the volumes.
using SweptVolumes = std::map<std::int32_t, double>;

// Computes the volumes between two openings. Fails if the patches cannot be made at an opening. If the two openings are swapped,
// only the sign of the result changes.
SweptVolumes swept_volumes(const Valve &valve, double opening_from, double opening_to, int n_threads);

}  // namespace riis
