// SPDX-License-Identifier: Apache-2.0
// Patches of arcs from one curve to another (paper, appendix, "Leaflet surfaces"). At each u, an arc joins the base (the annulus)
// to the edge (the leaflet's free edge). The arc is a quadratic Bézier curve. Its middle control point is the middle of its chord
// plus the offset
//     O(u) = factor |W| unit(W x T),  W(u) = edge(u) - base(u),  T(u) the base's direction.
// Thus D(u,v) = (1-v) base(u) + v edge(u) + 2 v (1-v) O(u). (The paper offsets along edge' x base', by a number that is not a
// length. The product edge' x base' is 0 where edge' is 0, and changes its sign at the edge's corners: docs/theory/mitral.md.)
// This file computes O(u) from two curves and the factor, and bounds how far O deviates from a linear function between two values
// of u.
#pragma once

#include "base/recycled.hpp"
#include "geometry/curve.hpp"
#include "geometry/vec3.hpp"

namespace riis {

// Returns O from W and T, or 0 if O has no direction.
Vec3 arc_offset(Vec3 width, Vec3 along, double factor);

// Returns O on a side that is itself an arc. Two patches that share the side get the same bits, because O comes from the arc's
// control points.
inline Vec3 arc_offset(const Bezier &arc) { return arc.control[1] - 0.5 * (arc.control[0] + arc.control[2]); }

// The parts of base and edge on a range of u whose width is du, and the lengths of both whole curves.
struct ArcRange {
  const Vector<Bezier> &base, &edge;
  double base_length, edge_length;
  double du;
};

// Bounds on O within a range of u.
struct OffsetBounds {
  double second;   // bounds |O''| on the smooth parts; infinite if W may be parallel to T
  double largest;  // bounds 2 |O|
};
OffsetBounds bound_offset(const ArcRange &range, double factor);

class Bulge {
 public:
  // Keeps copies of both curves. The edge may be a point.
  Bulge(Curve base, Curve edge, double factor);

  // A place u on both curves of a patch of arcs, and the offset O there.
  struct Place {
    double u;
    PointOnSpan on_base, on_edge;
    Vec3 offset;  // 0 where base and edge touch
  };
  Place place(double u) const;

  // Returns the start of the arc at u.
  Vec3 on_base(double u) const { return base_.at(u); }

  // Bounds the distance of O(u) from its linear interpolation between two places, for all u between them. The bound falls with
  // the square of the distance between the places. If W becomes parallel to T, O has no direction, and the bound stays at 2
  // |factor| |W|. The function refines the bound only until it is at most `enough`.
  double linear_error(const Place &from, const Place &to, double enough) const;

  // Returns the u of the curves' joints, ascending. O may have kinks there.
  const Vector<double> &joints() const { return joints_; }

 private:
  double sampled_error(const Place &from, const Place &to) const;
  double error_between(double u0, double u1, int n, double second) const;
  double jump(double u) const;

  Curve base_, edge_;
  double factor_;
  Vector<double> joints_;
};

}  // namespace riis
