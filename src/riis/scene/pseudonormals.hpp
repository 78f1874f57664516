// SPDX-License-Identifier: Apache-2.0
// Angle-weighted normals of vertices and edges. These normals tell on which side of a surface a point is, even if the closest
// point lies on an edge or a vertex (J. A. Baerentzen, H. Aanaes, "Signed distance computation using the angle weighted
// pseudonormal", IEEE TVCG 11(3), 2005). On an open surface, the side is that of the nearest part of the surface. For any closest
// point, this file gives the normal, the rate of the normal, and whether the point is on the rim of the surface.
#pragma once

#include <array>
#include <cstdint>

#include "base/recycled.hpp"
#include "common/array_view.hpp"
#include "triangulate/triangle_set.hpp"

namespace riis {

// Numbers the positions of all vertices. Vertices with equal coordinates get the same number.
UnfilledShortVector<std::int32_t> distinct_positions(const TriangleSet &set, std::int64_t &n_positions);

// Returns the unit normal of a triangle by the right-hand rule.
Vec3 triangle_normal(const std::array<Vec3, 3> &corners);

// Returns on which side of the surface a point is: +1, -1 or 0. `way` leads from the closest point of the surface to the point,
// and `normal` is the normal at the closest point.
inline int side_of(Vec3 way, Vec3 normal) {
  const double height = dot(way, normal);
  return (height > 0) - (height < 0);
}

class Pseudonormals {
 public:
  explicit Pseudonormals(const TriangleSet &set);

  Vec3 of_face(std::int64_t triangle) const { return view(face_)[triangle]; }

  // The normal at a closest point, and whether the point is on the rim. The barycentric weights tell whether the point lies on a
  // face, an edge or a vertex. The normal may have any length. The rim of a valve consists of the sides that only one patch has
  // (valve/rims.hpp). The rim of triangles from arrays consists of the edges that only one triangle has.
  struct Feature {
    Vec3 normal;
    bool is_on_rim;
  };
  Feature at(std::int64_t triangle, const std::array<double, 3> &barycentric) const {
    // Most closest points are inside a face, so this case is decided inline.
    const bool is_inside = barycentric[0] != 0 && barycentric[1] != 0 && barycentric[2] != 0;
    return is_inside ? Feature{of_face(triangle), false}
                     : at_border(triangle, {barycentric[0], barycentric[1], barycentric[2]});
  }
  // Returns the normal, and whether the point is on the rim, for a point that may lie on an edge or a vertex.
  Feature at_border(std::int64_t triangle, Vec3 barycentric) const;

  // Returns two triangles whose windings disagree: both run along a shared edge in the same direction. If there are none, returns
  // -1 and -1.
  const std::array<std::int64_t, 2> &disagreeing() const { return disagreeing_; }

  // Each edge of the rim and each vertex has a sum of normals. This struct has the rates of these sums while the vertices move.
  struct Rates {
    Vector<Vec3> rim_edge;  // three for each triangle; 0 for edges off the rim
    Vector<Vec3> corner;    // one for each distinct position
  };
  // Computes the rates, if the vertices of the set move at `rates`, (3, n_vertices).
  Rates rates_of(const TriangleSet &set, const double *rates) const;
  // Returns the rate of the unit normal at a closest point on the rim.
  Vec3 rate_at_rim(const Rates &rates, const TriangleSet &set, const double *vertex_rates, std::int64_t triangle,
                   Vec3 barycentric) const;

 private:
  // The vertex, edge or face on which a point with given barycentric weights lies. `corner` is the vertex, or the corner at which
  // the edge begins.
  enum class Kind { face, edge, vertex };
  struct Simplex {
    Kind kind;
    std::int64_t corner;
  };
  static Simplex simplex_of(Vec3 barycentric);

  // The positions of an edge's two ends.
  struct Ends {
    std::int32_t lower, upper;
  };
  Ends ends_of(std::int64_t slot) const;

  void note_rim(std::int64_t slot);
  void note_directions(std::int64_t slot, std::int64_t other);
  void note_rim_sides(const TriangleSet &set);

  UnfilledShortVector<Vec3> face_;              // one for each triangle
  UnfilledShortVector<Vec3> edge_;              // three for each triangle: edge k runs from corner k to corner k + 1
  Vector<Vec3> corner_;                         // one for each distinct position
  UnfilledShortVector<std::int32_t> position_;  // three for each triangle: the number of each corner's position
  Vector<std::uint8_t> edge_is_rim_, corner_is_rim_;
  std::array<std::int64_t, 2> disagreeing_{-1, -1};
};

}  // namespace riis
