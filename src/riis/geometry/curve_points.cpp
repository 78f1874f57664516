// SPDX-License-Identifier: Apache-2.0
#include "geometry/curve_points.hpp"

#include <algorithm>

namespace riis {
namespace {

// Returns the part of a span from t0 to t1.
Bezier part_of(const Bezier &span, double t0, double t1) {
  const Bezier left = t1 < 1 ? split(span, t1).first : span;
  return t0 > 0 ? split(left, t0 / t1).second : left;
}

}  // namespace

CurvePoints::CurvePoints(const Curve &curve, bool is_reversed, const Vector<double> &shares)
    : curve_(curve), is_reversed_(is_reversed), shares_(shares) {
  const Vector<Bezier> &spans = curve.spans();
  const std::size_t n = shares.size();
  points_.reserve(n);
  const auto behind = [&](std::size_t i) { return (is_reversed ? 1 - shares[n - 1 - i] : shares[i]) * curve.length(); };
  Vector<double> in_span, t;
  in_span.reserve(n);
  t.reserve(n);
  double start = 0;
  for (std::size_t span = 0; span < spans.size(); ++span) {
    const double length = curve.length(span);
    const bool is_last = span + 1 == spans.size();
    // A share at a joint belongs to the later span, also if rounding puts it slightly before the joint.
    const double end = is_last ? curve.length() : start + length - negligible_share * curve.length();
    in_span.clear();
    for (std::size_t i = points_.size(); i < n && (is_last || behind(i) < end); ++i) {
      const double from_start = behind(i) - start;
      in_span.push_back(from_start <= negligible_share * curve.length() ? 0 : std::min(from_start, length));
      points_.push_back({span, 0});
    }
    t.assign(in_span.size(), 0);
    parameters_at_lengths(spans[span], length, in_span, t.data());
    const std::size_t first = points_.size() - in_span.size();
    for (std::size_t k = 0; k < t.size(); ++k) points_[first + k].t = in_span[k] == 0 ? 0 : t[k];
    start += length;
  }
  // The first and the last point are exactly the curve's end points.
  points_.front() = {0, 0};
  points_.back() = {spans.size() - 1, 1};
}

Vec3 CurvePoints::point(std::size_t i) const {
  const PointOnSpan &at = on_span(i);
  return evaluate(curve_.spans()[at.span], at.t);
}

Vec3 CurvePoints::tangent(std::size_t i) const {
  const PointOnSpan &at = on_span(i);
  const Vec3 along = derivative(curve_.spans()[at.span], at.t);
  const double speed = length(along);
  if (!(speed > 0)) return {0, 0, 0};
  return (is_reversed_ ? -1 / speed : 1 / speed) * along;
}

const Vector<Bezier> &CurvePoints::between(std::size_t i, std::size_t j) {
  const PointOnSpan &from = is_reversed_ ? on_span(j) : on_span(i), &to = is_reversed_ ? on_span(i) : on_span(j);
  parts_.clear();
  parts_.reserve(to.span - from.span + 1);
  for (std::size_t span = from.span; span <= to.span; ++span) {
    const double t0 = span == from.span ? from.t : 0, t1 = span == to.span ? to.t : 1;
    // If the last point lies at the start of its span, the part contains nothing of that span.
    if (t1 > t0) parts_.push_back(part_of(curve_.spans()[span], t0, t1));
  }
  if (parts_.empty()) parts_.push_back(Bezier::point(point(i)));
  if (is_reversed_) reverse(parts_);
  return parts_;
}

double CurvePoints::chord_error(std::size_t i, std::size_t j, double enough) {
  const double part_length = (shares_[j] - shares_[i]) * curve_.length();
  if (!(part_length > 0)) return 0;
  const double eighth = 0.125 * part_length * part_length;
  const PointOnSpan &from = is_reversed_ ? on_span(j) : on_span(i), &to = is_reversed_ ? on_span(i) : on_span(j);
  double quick = 0, close = 0;
  for (std::size_t span = from.span; span <= to.span; ++span) {
    const double t0 = span == from.span ? from.t : 0, t1 = span == to.span ? to.t : 1;
    if (t1 > t0) quick = std::max(quick, eighth * rough_curvature(curve_.spans()[span], t0, t1));
  }
  if (quick <= enough) return quick;
  between(i, j);
  for (const Bezier &part : parts_) close = std::max(close, eighth * largest_curvature(part));
  return std::min(part_length, close);
}

}  // namespace riis
