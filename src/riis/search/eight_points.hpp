// SPDX-License-Identifier: Apache-2.0
// Up to eight points, each with its closest triangle. The kernels compute the data of the eight closest points together.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "geometry/vec3.hpp"
#include "kernels/kernels.hpp"
#include "scene/pseudonormals.hpp"

namespace riis {

struct EightPoints {
  typedef double Lanes[3][pairs_at_once];

  std::int64_t triangle[pairs_at_once];  // positions in the surface's set
  PointsAndTriangles pairs;
  PointsOnTriangles on;  // the closest points, if they were located

  // Sets a point and its triangle. `corners` has nine numbers for each triangle of the surface.
  void set(std::int64_t lane, Vec3 p, std::int64_t closest, const double *corners) {
    triangle[lane] = closest;
    pairs.corners[lane] = corners + 9 * closest;
    set_lane(pairs.point, lane, p);
  }

  // Finds the side of each point, and whether the closest point is on the rim. The closest points must have been located. Each
  // array may be null.
  void find_sides(const Pseudonormals &normals, const Kernels &simd, std::int32_t *side,
                  std::int32_t *is_on_rim) const {
    alignas(64) Lanes normal_there;
    find_normals(normals, normal_there, is_on_rim);
    if (side) simd.find_sides(pairs, on, normal_there, side);
  }

  // For each point, finds its height above the surface, as Band uses it, and whether the closest point is on the rim. The
  // magnitude of the height is at most the distance.
  void find_heights(const Pseudonormals &normals, const Kernels &simd, const double *distance, double *height,
                    std::int32_t *is_on_rim) const {
    alignas(64) Lanes normal_there;
    std::int32_t side[pairs_at_once];
    find_normals(normals, normal_there, is_on_rim);
    simd.find_sides(pairs, on, normal_there, side);
    for (std::int64_t lane = 0; lane < pairs_at_once; ++lane) height[lane] = side[lane] * distance[lane];
    for (std::uint32_t lanes = on.at_border; lanes; lanes &= lanes - 1) {
      const std::int64_t lane = __builtin_ctz(lanes);
      if (!is_on_rim[lane]) continue;
      const Vec3 normal = lane_of(normal_there, lane);
      const double over = dot(lane_of(pairs.point, lane) - lane_of(on.point, lane), normal) / length(normal);
      height[lane] = std::max(-distance[lane], std::min(over, distance[lane]));
    }
  }

  // Finds the normal at each closest point, and whether the point is on the rim. `is_on_rim` may be null.
  void find_normals(const Pseudonormals &normals, Lanes &normal_there, std::int32_t *is_on_rim) const {
    for (std::int64_t lane = 0; lane < pairs_at_once; ++lane) {
      set_lane(normal_there, lane, normals.of_face(triangle[lane]));
      if (is_on_rim) is_on_rim[lane] = 0;
    }
    for (std::uint32_t lanes = on.at_border; lanes; lanes &= lanes - 1) {
      const std::int64_t lane = __builtin_ctz(lanes);
      const Pseudonormals::Feature feature = normals.at_border(triangle[lane], lane_of(on.barycentric, lane));
      set_lane(normal_there, lane, feature.normal);
      if (is_on_rim) is_on_rim[lane] = feature.is_on_rim ? 1 : 0;
    }
  }

  static void set_lane(Lanes &to, std::int64_t lane, Vec3 v) {
    to[0][lane] = v.x;
    to[1][lane] = v.y;
    to[2][lane] = v.z;
  }
  static Vec3 lane_of(const Lanes &from, std::int64_t lane) { return {from[0][lane], from[1][lane], from[2][lane]}; }
  // Writes the coordinates of one lane as a vector. Three plain assignments would be slower when compiled by GCC.
  static void put_lane(const Lanes &from, std::int64_t lane, double *to) {
    typedef double Two
        __attribute__((vector_size(16)));  // every processor of the baseline instruction set has such registers
    const Two xy = {from[0][lane], from[1][lane]};
    std::memcpy(to, &xy, sizeof xy);
    to[2] = from[2][lane];
  }
};

}  // namespace riis
