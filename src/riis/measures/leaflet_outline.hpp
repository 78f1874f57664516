// SPDX-License-Identifier: Apache-2.0
// The outline of the leaflets, which bounds the orifice. The outline consists of the edges that are farthest from a centre. They
// are seen along an axis, which is computed from these edges (docs/theory/measures.md, "Outline"). From the leaflets' boundary,
// this file finds a polygon in a plane, and the axis along which the polygon is seen.
#pragma once

#include <optional>

#include "geometry/vec3.hpp"
#include "measures/leaflet_boundary.hpp"
#include "measures/plane_cover.hpp"

namespace riis {

// Projects points along an axis of length 1.
class AlongAxis {
 public:
  // The origin is projected to (0, 0). The plane's first axis is its direction nearest to `sideways`. If `sideways` is 0 or
  // nearly parallel to the axis, a coordinate axis is used instead of `sideways`.
  AlongAxis(Vec3 axis, Vec3 origin, Vec3 sideways);

  Vec3 axis() const { return axis_; }
  // The rounding error is proportional to the distance between the projection's origin and the origin of coordinates.
  double rounding() const { return 0x1p-48 * length(origin_); }

  PlanePoint operator()(Vec3 p) const {
    const Vec3 from_origin = p - origin_;
    return {dot(x_axis_, from_origin), dot(y_axis_, from_origin)};
  }
  // Returns the point of the plane through the origin that is projected to p.
  Vec3 in_space(const PlanePoint &p) const { return origin_ + p[0] * x_axis_ + p[1] * y_axis_; }

 private:
  Vec3 x_axis_{}, y_axis_{}, axis_, origin_;
};

// A line of open edges can be the attachment only if its area is at least this share of the outline's area.
inline constexpr double least_attached_share = 0.8;

// An outline with the axis along which it is seen.
struct SeenOutline {
  AlongAxis seen;
  Outline outline;
};

// Directions of a valve, from which the search for its outline begins.
struct ValveDirections {
  Vec3 axis, sideways;  // its z axis, warped and placed, and its x axis, placed
  bool keeps_axis;      // whether the outline is seen along `axis`, or else along the vector area of its edges
};

// Returns the outline and its axis, which points to the side of the valve's axis. Triangles from arrays have no valve, so their
// axis points to the side of the boundary's normal. Returns nothing if the edges do not surround a centre, or enclose no area.
std::optional<SeenOutline> outline_of_leaflets(const LeafletBoundary &boundary,
                                               const std::optional<ValveDirections> &valve);

}  // namespace riis
