// SPDX-License-Identifier: Apache-2.0
// Finds, on the triangles of a surface, the closest points to many points that belong to no mesh. The points and the results are
// in the caller's arrays.
#pragma once

#include <riis/riis.h>

#include <cstdint>

#include "geometry/strided.hpp"
#include "geometry/vec3.hpp"
#include "parallel/threads.hpp"
#include "scene/surface.hpp"

namespace riis {

// The points for which the caller wants results: all points, the points of a mask, or the points of a list.
struct WantedPoints {
  std::int64_t n;  // the length of the list, or the number of all points
  const std::uint8_t *mask = nullptr;
  const std::int64_t *ids = nullptr;  // ascending
  Bounds bounds = {};                 // the box of all points, or of the list's points

  // Returns the id of the k-th wanted point.
  std::int64_t id(std::int64_t k) const { return ids ? ids[k] : k; }
  bool is_wanted(std::int64_t id) const { return !mask || mask[id] != 0; }
};

struct ClosestPointsRequest {
  const Surface &surface;  // a surface that measures distances to its triangles
  WantedPoints wanted;
  double limit, far_distance;  // points beyond the limit get far_distance
  Threads n_threads;
};

// Writes the wanted entries of the arrays. The points must have been checked. If memory runs out, the arrays are unchanged.
template <class Real>
void find_closest_points(const ClosestPointsRequest &request, const StridedReals<Real> &points,
                         const riis_closest_arrays &to);

// Writes entry i of the wanted arrays for a point whose closest triangle was found.
void write_closest(const Surface &surface, std::int64_t i, Vec3 p, const ClosestTriangle &closest,
                   const riis_closest_arrays &to);

// Writes entry i for a point beyond the limit.
void write_far(std::int64_t i, double far_distance, const riis_closest_arrays &to);

}  // namespace riis
