// SPDX-License-Identifier: Apache-2.0
#include "search/band_nodes.hpp"

#include <limits>

#include "kernels/kernels.hpp"
#include "search/eight_points.hpp"

namespace riis {

NodePlaces::NodePlaces(const SearchRequest &request)
    : request_(request), normals_(request.surface.band().steps_aside() ? &request.surface.pseudonormals() : nullptr) {}

NodePlace NodePlaces::of(Vec3 p) const {
  return with_distances(request_.surface, request_.instructions, [&](const auto &distances) -> NodePlace {
    const ClosestTriangle closest = distances.closest(p, std::numeric_limits<double>::infinity());
    const double distance = std::sqrt(closest.distance_sq);
    if (!normals_) return {distance, 0, false};
    EightPoints eight;
    double distances_of_all[pairs_at_once], height[pairs_at_once];
    std::int32_t is_on_rim[pairs_at_once];
    for (std::int64_t lane = 0; lane < pairs_at_once; ++lane) {
      eight.set(lane, p, closest.triangle, request_.surface.scene().groups().corners.data());
      distances_of_all[lane] = distance;
    }
    const Kernels &simd = kernels(request_.instructions);
    simd.locate(eight.pairs, eight.on);
    eight.find_heights(*normals_, simd, distances_of_all, height, is_on_rim);
    const int side = (height[0] > 0) - (height[0] < 0);
    return {request_.surface.band().marking_thickness(distance, height[0]), side, is_on_rim[0] != 0};
  });
}

}  // namespace riis
