// SPDX-License-Identifier: Apache-2.0
// The method that a surface's options ask for.
#pragma once

#include <cstdint>
#include <memory>

#include "distance/patch_distance.hpp"

namespace riis {

struct DistanceRequest {
  std::int32_t method;  // RIIS_DISTANCE_SAMPLING or RIIS_DISTANCE_MINIMIZATION
  double max_error;     // distance_tolerance * half_thickness, placed units
};

// Fails with RIIS_LIMIT_EXCEEDED where patches or samples would be too many.
std::unique_ptr<const PatchDistance> make_distance(const PatchSet &set, const DistanceRequest &request,
                                                   const Placement &placement, bool flip_normals);

}  // namespace riis
