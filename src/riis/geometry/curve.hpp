// SPDX-License-Identifier: Apache-2.0
// Curves of one or several Bézier spans, parametrised by the share of the length: 0 at the first point, 1 at the last.
// This file finds points and parts of a curve by share, and makes polylines that approximate a curve.
#pragma once

#include <array>
#include <cstddef>

#include "base/recycled.hpp"
#include "geometry/bezier.hpp"
#include "geometry/vec3.hpp"

namespace riis {

// Shares of a curve's length up to this number count as 0.
inline constexpr double negligible_share = 1e-14;

// A point of a curve: the index of its span, and the parameter on that span.
struct PointOnSpan {
  std::size_t span;
  double t;
};

// Each span begins where the previous span ends, and continues in the same direction. At a joint, the curvature may therefore
// jump, but the direction does not. (A curve with corners is stored as several curves, and its patch as several patches.)
class Curve {
 public:
  Curve(const Bezier &span);  // NOLINT(google-explicit-constructor): a single span is a curve
  explicit Curve(Vector<Bezier> spans);

  const Vector<Bezier> &spans() const { return spans_; }
  double length() const { return ends_.back(); }
  double length(std::size_t span) const { return span == 0 ? ends_[0] : ends_[span] - ends_[span - 1]; }
  Vec3 first() const { return spans_.front().first(); }
  Vec3 last() const { return spans_.back().last(); }

  // Returns the shares of the length at which one span ends and the next begins, in ascending order.
  Vector<double> joints() const;

  // The point at a share of a curve's length, and the unit tangent there. The tangent is 0 if the curve has no direction.
  struct PointAndTangent {
    Vec3 point, tangent;
  };
  PointAndTangent with_tangent(double share) const { return with_tangent(on_span(share)); }
  PointAndTangent with_tangent(const PointOnSpan &where) const;
  Vec3 at(double share) const { return at(on_span(share)); }
  Vec3 at(const PointOnSpan &where) const { return evaluate(spans_[where.span], where.t); }

  // Finds the point at a share of the length, by Newton's method.
  PointOnSpan on_span(double share) const;
  // Returns the points that divide the part between two shares, from.share < to.share, into eight parts of equal length.
  struct Place {
    double share;
    PointOnSpan where;
  };
  std::array<PointOnSpan, 7> divide(const Place &from, const Place &to) const;

  // Returns the part of a span beside the point at this share of the length. If `after` is true, the part leads from this point
  // to the end of the span. Otherwise the part leads from the start of the span to this point.
  Bezier span_beside(double share, bool after) const;

  // Returns the part from share0 to share1, where share0 < share1.
  Curve between(double share0, double share1) const { return Curve(spans_between(on_span(share0), on_span(share1))); }
  // Returns the spans of the part from one point to a later point.
  Vector<Bezier> spans_between(const PointOnSpan &from, const PointOnSpan &to) const;

  Curve reversed() const;

  // Returns the curve with its ends moved exactly to `first` and `last`. These are ends of neighbouring curves, and differ from
  // the curve's own ends only by rounding.
  Curve through(Vec3 first, Vec3 last) const;

 private:
  Vector<Bezier> spans_;
  Vector<double> ends_;  // the length from the start of the curve to the end of each span
};

// Reverses the direction of the successive spans.
void reverse(Vector<Bezier> &spans);

// Returns whether both curves have exactly the same control points.
bool are_equal(const Curve &a, const Curve &b);

// Estimates how far the velocity of a curve's points deviates from its linear interpolation along the curve. While the curve
// moves, each point stays at the same fraction of the length.
class VelocityBend {
 public:
  // The control points of `velocity` are the velocities of the control points of the curve's spans.
  VelocityBend(const Curve &curve, const Vector<Bezier> &velocity);

  // Estimates how far the velocity deviates from its linear interpolation between the shares u0 and u1 of the length.
  double off_linear(double u0, double u1) const;

 private:
  // A part of a span. Between the two shares, the bend (the second derivative of the velocity by the share) is approximated by a
  // linear function.
  struct Cell {
    double u0, u1, bend0, bend1;

    double at(double u) const {
      const double share = (u - u0) / (u1 - u0);
      return (1 - share) * bend0 + share * bend1;
    }
  };
  static constexpr std::size_t n_cells = 8;  // the number of cells of each span

  Vector<Cell> cells_;
};

// A polyline whose chords replace a curve.
struct Flattened {
  Vector<Vec3> points;    // points of the curve, from first to last; only the first for length 0
  Vector<double> t;       // the share of the curve's length at every point, a binary fraction from 0 to 1
  Vector<double> errors;  // for every chord: a bound on its distance from the curve, at equal shares of their lengths
};

// Halves the curve until two conditions hold for every part. First, the part's flatness shows that the part lies within max_error
// (> 0) of its chord. The distance of a Bézier span from its chord is at most 3/4 (cubic) or 1/2 (quadratic) of the flatness.
// Second, the part and its chord are at most max_error apart at equal shares of their lengths. With `bend`, a part is also halved
// if its velocity is estimated to differ from a linear function by more than max_bend. Parts are halved by length, whereas the
// paper (algorithm "Recursive de Casteljau subdivision") halves the parameter. The shares of any two curves are therefore binary
// fractions: they agree to the last bit or differ by at least one part, so no slivers arise. The common point of two successive
// parts appears only once in the result. Fails with RIIS_LIMIT_EXCEEDED for more than 2^20 parts.
Flattened flatten(const Curve &curve, double max_error, const VelocityBend *bend = nullptr, double max_bend = 0);

// Points of a curve at many shares of its length, found in one pass.
// This class also gives the tangents at these points, and bounds for the parts between them.
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

  // Returns the spans of the curve from share i to share j, i < j, in the order of the shares. The returned reference is valid
  // until the next call.
  const Vector<Bezier> &between(std::size_t i, std::size_t j);

  // Bounds the distance between a curve and its chord from share i to share j, at equal shares of their lengths
  // (docs/theory/curves.md, "Chord error"). The function refines the bound only until it is at most `enough`.
  double chord_error(std::size_t i, std::size_t j, double enough);

 private:
  const PointOnSpan &on_span(std::size_t i) const { return points_[is_reversed_ ? points_.size() - 1 - i : i]; }

  const Curve &curve_;
  bool is_reversed_;
  const Vector<double> &shares_;
  Vector<PointOnSpan> points_;  // in the order along the curve
  Vector<Bezier> parts_;
};

// Polylines parametrised by length (paper, 3.2.2 "Polyline").
// A polyline is made from points or from a curve. The polyline gives C(t) for t in [0,1], where t is the share of the length.
struct Polyline {
  Vector<Vec3> points;    // at least 1
  Vector<double> t;       // t of every point, ascending from 0 to 1; a single 0 if the length is 0
  Vector<double> errors;  // for every segment, a bound on its distance from the replaced curve at equal t
  double length;          // the length of that curve
};

// Returns the polyline through the points, parametrised by its own length. Its errors are 0, because it replaces no curve. Drops
// repeated points, so that t ascends strictly. Needs at least one point.
Polyline make_polyline(const Vector<Vec3> &points);

// Returns a polyline that replaces a curve. Every segment is within max_error (> 0) of the curve. The t of a vertex is the
// fraction of the curve's length up to the vertex. The paper takes the fraction of the polyline's length instead. The vertex at t
// is therefore the curve's point at t, whatever the tolerance.
Polyline make_polyline(const Curve &curve, double max_error);
// Makes the polyline of a curve that moves. On each segment, the velocity is estimated to be within max_bend of a linear
// function. `velocity` has the velocities of the spans' control points.
Polyline make_polyline(const Curve &curve, double max_error, const Vector<Bezier> &velocity, double max_bend);

// Returns the same polyline in the opposite direction.
Polyline reversed(const Polyline &polyline);

// Returns C(t) by linear interpolation, t in [0,1]. At the t of a vertex the result is exactly the vertex, and C(1) is the last
// point. (The paper uses the smallest t_i > t, which does not exist at t = 1.)
Vec3 evaluate(const Polyline &polyline, double t);

}  // namespace riis
