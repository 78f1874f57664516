// SPDX-License-Identifier: Apache-2.0
// Patches of arcs from one curve to another (paper, appendix, "Leaflet surfaces"): every line from a point of the base
// (the annulus) to the edge's point at the same u (the leaflet's free edge) is a quadratic Bézier curve whose middle control point
// lies off the straight line's middle by
//     O(u) = factor |W| unit(W x T),  W(u) = edge(u) - base(u),  T(u) the base's direction,
// so that D(u,v) = (1-v) base(u) + v edge(u) + 2 v (1-v) O(u). (The paper offsets along edge' x base', which vanishes where the
// edge stands still and turns over at its corners, and by a number without a length: docs/theory.md.)
// In: two curves and the factor. Out: O(u), and how far it may be from linear between two u.
#pragma once

#include <vector>

#include "geometry/curve.hpp"
#include "geometry/vec3.hpp"

namespace riis {

// O from W and T; 0 where it has no direction.
Vec3 arc_offset(Vec3 width, Vec3 along, double factor);

class Bulge {
 public:
  // Keeps copies. The edge may be a point.
  Bulge(Curve base, Curve edge, double factor);

  // O(u). Where base and edge touch it is 0.
  Vec3 at(double u) const;

  // Where the arc at u begins.
  Vec3 on_base(double u) const { return base_.at(u); }

  // A bound on |O(u) - its linear interpolation between u0 and u1| for u0 <= u <= u1. It falls with (u1 - u0)^2, but for
  // where W gets parallel to T and O has no direction: there it stays at 2 |factor| |W|.
  // Looks no closer once it is at most enough.
  double linear_error(double u0, double u1, double enough) const;

  // u at which O may change its course, ascending: joints of the curves.
  const std::vector<double> &joints() const { return joints_; }

 private:
  double sampled_error(const Curve &base, const Curve &edge, double u0, double u1, int n, double second) const;
  double jump(double u) const;

  Curve base_, edge_;
  double factor_;
  std::vector<double> joints_;
};

}  // namespace riis
