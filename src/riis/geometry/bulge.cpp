// SPDX-License-Identifier: Apache-2.0
#include "geometry/bulge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/interval.hpp"

namespace riis {

Vec3 arc_offset(Vec3 width, Vec3 along, double factor) {
  const Vec3 across = cross(width, along);
  const double size = length(across);
  return size > 0 ? (factor * length(width) / size) * across : Vec3{0, 0, 0};
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Returns the hull of control points of a Bézier curve's derivative. The derivative stays inside it.
IntervalVector hull_of(const Vec3 *control, std::size_t n) {
  IntervalVector all = IntervalVector::of(control[0]);
  for (std::size_t i = 1; i < n; ++i) all = hull(all, IntervalVector::of(control[i]));
  return all;
}

// A curve's unit tangent on a range of u, with its derivatives by u, and the speed |d curve / du| there.
struct Along {
  JetVector tangent;
  double speed;
};

// Returns the tangent with its derivatives by u, from derivatives of a Bézier piece by its own parameter t. The chain rule uses
// dt/du = speed / |B'(t)|.
JetVector tangent_jet(const IntervalVector &d1, const IntervalVector &d2, const IntervalVector &d3, double speed) {
  const JetVector along = JetVector::of(d1, d2, d3);
  const Jet size = root(dot_self(along)), inverse_size = inverse(size);
  const JetVector by_t = inverse_size * along;
  const Interval t_u = speed * inverse_size.value;
  const Interval t_uu = -(speed * speed) * (size.first * inverse_size.value * square(inverse_size.value));
  const auto by_u = [&](const Jet &a) {
    return Jet{intersection(a.value, {-1, 1}), a.first * t_u, a.second * square(t_u) + a.first * t_uu};
  };
  return {by_u(by_t.x), by_u(by_t.y), by_u(by_t.z)};
}

struct Derivatives {
  explicit Derivatives(const Bezier &piece) : n(static_cast<std::size_t>(piece.degree)) {
    const double degree = piece.degree;
    for (std::size_t i = 0; i < n; ++i) first[i] = degree * (piece.control[i + 1] - piece.control[i]);
    for (std::size_t i = 0; i + 1 < n; ++i) second[i] = (degree - 1) * (first[i + 1] - first[i]);
    third = n == 3 ? second[1] - second[0] : Vec3{0, 0, 0};
  }

  std::size_t n;
  std::array<Vec3, 3> first;
  std::array<Vec3, 2> second;
  Vec3 third;
};

// Bounds the distance of a function from the line between its ends, on a range of length du. `second` holds its second
// derivative.
double deviation(const Interval &second, double du) { return 0.125 * du * du * second.magnitude(); }

void narrow(Jet &a, double start, double end, double du) {
  a.value = intersection(a.value, widened(hull(Interval::of(start), Interval::of(end)), deviation(a.second, du)));
}

Vec3 unit(Vec3 a) {
  const double size = length(a);
  return size > 0 ? (1 / size) * a : a;
}

// Returns the tangent over a whole piece. The piece spans at most du.
Along along_piece(const Bezier &piece, double speed, double du) {
  if (!(speed > 0)) return {JetVector{}, 0};
  const Derivatives d(piece);
  JetVector tangent =
      tangent_jet(hull_of(d.first.data(), d.n), hull_of(d.second.data(), d.n - 1), IntervalVector::of(d.third), speed);
  const Vec3 start = unit(d.first[0]), end = unit(d.first[d.n - 1]);
  narrow(tangent.x, start.x, end.x, du);
  narrow(tangent.y, start.y, end.y, du);
  narrow(tangent.z, start.z, end.z, du);
  return {tangent, speed};
}

// Returns the tangent at the start or the end of a piece.
Along along_end(const Bezier &piece, double speed, bool at_end) {
  if (!(speed > 0)) return {JetVector{}, 0};
  const Derivatives d(piece);
  return {tangent_jet(IntervalVector::of(d.first[at_end ? d.n - 1 : 0]),
                      IntervalVector::of(d.second[at_end ? d.n - 2 : 0]), IntervalVector::of(d.third), speed),
          speed};
}

double norm(const IntervalVector &a) {
  const double bound = length(a.magnitudes());
  return bound >= 0 ? bound : infinity;  // the length is NaN if infinite bounds cancelled
}

// Returns the offset O (bulge.hpp) with its derivatives, from W and the base's tangent. The derivative of W is the edge's
// derivative minus the base's. Returns nothing if W may be parallel to the base, because O may have no direction there.
std::optional<JetVector> offset_jet(const IntervalVector &w, const Along &base, const Along &edge, double factor) {
  const JetVector width = JetVector::of(w, edge.speed * edge.tangent.value() - base.speed * base.tangent.value(),
                                        edge.speed * edge.tangent.first() - base.speed * base.tangent.first());
  const JetVector across = cross(width, base.tangent);
  const Jet across_sq = dot_self(across);
  if (!(across_sq.value.low > 0)) return std::nullopt;
  // O is factor |W| M / |M| with M = W x T.
  return (factor * root(dot_self(width) * inverse(across_sq))) * across;
}

// Returns O at the same share of the length of both curves.
Vec3 offset_at(const Curve &base, const Curve &edge, double share, double factor) {
  const Curve::Frame on_base = base.frame(share);
  return arc_offset(edge.at(share) - on_base.point, on_base.tangent, factor);
}

}  // namespace

Bulge::Bulge(Curve base, Curve edge, double factor) : base_(std::move(base)), edge_(std::move(edge)), factor_(factor) {
  const Vector<double> of_base = base_.joints(), of_edge = edge_.joints();
  std::merge(of_base.begin(), of_base.end(), of_edge.begin(), of_edge.end(), std::back_inserter(joints_));
}

Vec3 Bulge::at(double u) const { return offset_at(base_, edge_, u, factor_); }

OffsetBounds bound_offset(const ArcRange &range, double factor) {
  const double du = range.du;
  // W stays near the line between its two end values. The largest bend over all pairs of pieces bounds the distance from this
  // line.
  const Vec3 start = range.edge.front().first() - range.base.front().first();
  const Vec3 end = range.edge.back().last() - range.base.back().last();
  Vector<Along> along_base, along_edge;
  for (const Bezier &piece : range.base) along_base.push_back(along_piece(piece, range.base_length, du));
  for (const Bezier &piece : range.edge) along_edge.push_back(along_piece(piece, range.edge_length, du));
  Vec3 bend{0, 0, 0};
  for (const Along &b : along_base)
    for (const Along &e : along_edge) {
      const Vec3 of_pair = (e.speed * e.tangent.first() - b.speed * b.tangent.first()).magnitudes();
      bend = {std::max(bend.x, of_pair.x), std::max(bend.y, of_pair.y), std::max(bend.z, of_pair.z)};
    }
  IntervalVector w = hull(IntervalVector::of(start), IntervalVector::of(end));
  const double eighth = 0.125 * du * du;
  w = {widened(w.x, eighth * bend.x), widened(w.y, eighth * bend.y), widened(w.z, eighth * bend.z)};

  double second = 0;
  for (const Along &b : along_base)
    for (const Along &e : along_edge) {
      const std::optional<JetVector> offset = offset_jet(w, b, e, factor);
      second = std::max(second, offset ? norm(offset->second()) : infinity);
    }
  // Neither |O| nor the length of its linear interpolation exceeds |factor| |W|.
  return {second, 2 * std::abs(factor) * norm(w)};
}

double Bulge::linear_error(double u0, double u1, double enough) const {
  const Curve base = base_.between(u0, u1), edge = edge_.length() > 0 ? edge_.between(u0, u1) : edge_;
  const OffsetBounds bounds =
      bound_offset({base.pieces(), edge.pieces(), base_.length(), edge_.length(), u1 - u0}, factor_);
  // Intervals overestimate |O''| several times over. So O is evaluated at a few points, and the bound on |O''| is used only
  // between neighbouring points. With n parts, this bound contributes n^2 times less.
  double error = infinity;
  for (int n = 1; n <= 8 && !(error <= enough); n *= 8) error = sampled_error(base, edge, u0, u1, n, bounds.second);
  return error <= bounds.largest ? error : bounds.largest;  // a NaN error also gives way to this bound
}

// Bounds the error of linear interpolation. Evaluates O at n - 1 points between u0 and u1, and uses the bound on |O''| between
// them.
double Bulge::sampled_error(const Curve &base, const Curve &edge, double u0, double u1, int n, double second) const {
  double off_line = 0;
  if (n > 1) {
    const Vec3 first = offset_at(base, edge, 0, factor_), last = offset_at(base, edge, 1, factor_);
    for (int i = 1; i < n; ++i) {
      const double share = static_cast<double>(i) / n;
      off_line = std::max(off_line, distance(offset_at(base, edge, share, factor_), mix(first, last, share)));
    }
  }
  const double step = (u1 - u0) / n;
  double between = 0.125 * step * step * second;
  // O' may jump at a joint. The jump adds a kink of height |jump| a b / (a + b), where a and b are the distances to the
  // evaluated points before and after the joint.
  for (const double joint : joints_) {
    if (!(joint > u0 && joint < u1)) continue;
    const double behind = std::fmod(joint - u0, step);
    between += jump(joint) * behind * (step - behind) / step;
  }
  return off_line + between;
}

// Bounds the size of the jump of O' at u, which is the difference between its values on both sides.
double Bulge::jump(double u) const {
  const IntervalVector w = IntervalVector::of(edge_.at(u) - base_.at(u));
  const auto beside = [&](bool after) {
    const auto along = [&](const Curve &curve) {
      return along_end(curve.piece_beside(u, after), curve.length(), !after);
    };
    return offset_jet(w, along(base_), along(edge_), factor_);
  };
  const std::optional<JetVector> before = beside(false), after = beside(true);
  return before && after ? norm(after->first() - before->first()) : infinity;
}

}  // namespace riis
