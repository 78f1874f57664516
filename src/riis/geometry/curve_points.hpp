// SPDX-License-Identifier: Apache-2.0
// Points of a curve at many shares of its length, found in one pass.
// In: a curve, ascending shares. Out: points, tangents, and bounds for the parts between them.
#pragma once

#include <cstddef>

#include "base/recycled.hpp"
#include "geometry/curve.hpp"

namespace riis {

class CurvePoints {
 public:
  // Finds the points at these shares, which ascend from 0 to 1. If is_reversed, the shares count from the curve's last point.
  // The curve and the shares must outlive this object. On a curve without length, all points coincide.
  CurvePoints(const Curve &curve, bool is_reversed, const Vector<double> &shares);

  std::size_t size() const { return points_.size(); }
  Vec3 point(std::size_t i) const;
  // span() returns the span that point i lies on, and parameter() returns the parameter on that span.
  std::size_t span(std::size_t i) const { return on_span(i).span; }
  double parameter(std::size_t i) const { return on_span(i).t; }
  // Returns the unit tangent, or 0 if the curve has no direction there.
  Vec3 tangent(std::size_t i) const;

  // Returns the spans of the curve from share i to share j, i < j, in the order of the shares. The reference is valid until the
  // next call.
  const Vector<Bezier> &between(std::size_t i, std::size_t j);

  // Bounds the distance between the chord from share i to share j and the curve, at equal shares of their lengths
  // (docs/theory.md, "Chord error"). The bound is not refined further once it is at most `enough`.
  double chord_error(std::size_t i, std::size_t j, double enough);

 private:
  const PointOnSpan &on_span(std::size_t i) const { return points_[is_reversed_ ? points_.size() - 1 - i : i]; }

  const Curve &curve_;
  bool is_reversed_;
  const Vector<double> &shares_;
  Vector<PointOnSpan> points_;  // in the order along the curve
  Vector<Bezier> parts_;
};

}  // namespace riis
