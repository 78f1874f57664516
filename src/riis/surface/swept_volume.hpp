// SPDX-License-Identifier: Apache-2.0
// The volume that a surface sweeps: the integral of u . n over the surface and time, positive along the normals.
// In: a valve and two openings, or keyframes and two times. Out: the volume of each leaflet.
#pragma once

#include <cstdint>
#include <map>

#include "surface/keyframes.hpp"
#include "valve/valve.hpp"

namespace riis {

// By leaflet_id, before any placement.
using SweptVolumes = std::map<std::int32_t, double>;

// Fails as making the patches does. The other direction has the opposite sign, and otherwise the same bits.
SweptVolumes swept_volumes(const Valve &valve, double opening_from, double opening_to, int n_threads);

// Fails with RIIS_LIMIT_EXCEEDED for more than a million keys between the times.
SweptVolumes swept_volumes(const Keyframes &frames, double time_from, double time_to);

}  // namespace riis
