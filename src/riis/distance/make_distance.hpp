// SPDX-License-Identifier: Apache-2.0
// Makes the distance method that a surface's options choose.
#pragma once

#include <cstdint>
#include <memory>

#include "distance/patch_distance.hpp"

namespace riis {

struct DistanceRequest {
  std::int32_t method;  // RIIS_MEASURE_SAMPLING or RIIS_MEASURE_MINIMIZATION
  double max_error;     // measure_tolerance * half_thickness, placed units
};

// Fails with RIIS_LIMIT_EXCEEDED if patches or samples would be too many.
std::unique_ptr<const PatchDistance> make_distance(const PatchSet &set, const DistanceRequest &request,
                                                   const Placement &placement, bool flip_normals);

}  // namespace riis
