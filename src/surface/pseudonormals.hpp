// SPDX-License-Identifier: Apache-2.0
// Angle-weighted normals of vertices and edges: they tell the side of a surface on which a point is, also where the
// closest point lies on an edge or a vertex (J. A. Baerentzen, H. Aanaes, "Signed distance computation using the angle
// weighted pseudonormal", IEEE TVCG 11(3), 2005). On an open surface this is the side of the nearest piece, which is
// what "side" can mean there. In: triangles. Out: a normal for any closest point.
#pragma once

#include <array>
#include <vector>

#include "surface/triangle_set.hpp"

namespace riis {

// Unit normal of a triangle by the right-hand rule.
Vec3 triangle_normal(const std::array<Vec3, 3> &corners);

class Pseudonormals {
 public:
  explicit Pseudonormals(const TriangleSet &set);

  // The normal, of any length, of the face, edge or vertex that the barycentric weights lie on.
  Vec3 at(std::size_t triangle, const std::array<double, 3> &barycentric) const;

 private:
  std::vector<Vec3> face_;             // one a triangle
  std::vector<Vec3> edge_;             // three a triangle; edge k runs from corner k to k + 1
  std::vector<Vec3> corner_;           // one a distinct position
  std::vector<std::size_t> position_;  // three a triangle: position of each corner
};

}  // namespace riis
