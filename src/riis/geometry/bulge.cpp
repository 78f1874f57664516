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

#include "common/array_view.hpp"
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
  const Interval t_u = speed * inverse_size.value, t_u_sq = square(t_u);
  const Interval t_uu = -(speed * speed) * (size.first * inverse_size.value * square(inverse_size.value));
  const auto by_u = [&](const Jet &a) {
    return Jet{intersection(a.value, {-1, 1}), a.first * t_u, a.second * t_u_sq + a.first * t_uu};
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

// O as the product of a factor and a vector, as jets.
struct OffsetJets {
  Jet factor;
  JetVector across;

  IntervalVector first() const {
    const auto of = [&](const Jet &a) { return factor.first * a.value + factor.value * a.first; };
    return {of(across.x), of(across.y), of(across.z)};
  }
  IntervalVector second() const {
    const auto of = [&](const Jet &a) {
      return factor.second * a.value + 2 * (factor.first * a.first) + factor.value * a.second;
    };
    return {of(across.x), of(across.y), of(across.z)};
  }
};

// Returns the offset O (bulge.hpp) from W and the base's tangent. The derivative of W is the edge's derivative minus the base's.
// Returns nothing if W may be parallel to the base, because O may have no direction there.
std::optional<OffsetJets> offset_jets(const IntervalVector &w, const Along &base, const Along &edge, double factor) {
  const JetVector width = JetVector::of(w, edge.speed * edge.tangent.value() - base.speed * base.tangent.value(),
                                        edge.speed * edge.tangent.first() - base.speed * base.tangent.first());
  const JetVector across = cross(width, base.tangent);
  const Jet across_sq = dot_self(across);
  if (!(across_sq.value.low > 0)) return std::nullopt;
  // O is factor |W| M / |M| with M = W x T.
  return OffsetJets{factor * root(dot_self(width) * inverse(across_sq)), across};
}

// Returns O at points at the same share of the length of both curves.
Vec3 offset_at(const Curve &base, const PointOnPiece &on_base, const Curve &edge, const PointOnPiece &on_edge,
               double factor) {
  const Curve::Frame frame = base.frame(on_base);
  return arc_offset(edge.at(on_edge) - frame.point, frame.tangent, factor);
}

}  // namespace

Bulge::Bulge(Curve base, Curve edge, double factor) : base_(std::move(base)), edge_(std::move(edge)), factor_(factor) {
  const Vector<double> of_base = base_.joints(), of_edge = edge_.joints();
  std::merge(of_base.begin(), of_base.end(), of_edge.begin(), of_edge.end(), std::back_inserter(joints_));
}

Bulge::Place Bulge::place(double u) const {
  const PointOnPiece on_base = base_.on_piece(u), on_edge = edge_.on_piece(u);
  return {u, on_base, on_edge, offset_at(base_, on_base, edge_, on_edge, factor_)};
}

OffsetBounds bound_offset(const ArcRange &range, double factor) {
  const double du = range.du;
  // W stays near the line between its two end values. The largest bend over all pairs of pieces bounds the distance from this
  // line.
  const Vec3 start = range.edge.front().first() - range.base.front().first();
  const Vec3 end = range.edge.back().last() - range.base.back().last();
  Vector<Along> along_base, along_edge;
  along_base.reserve(range.base.size());
  along_edge.reserve(range.edge.size());
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
      const std::optional<OffsetJets> offset = offset_jets(w, b, e, factor);
      second = std::max(second, offset ? norm(offset->second()) : infinity);
    }
  // Neither |O| nor the length of its linear interpolation exceeds |factor| |W|.
  return {second, 2 * std::abs(factor) * norm(w)};
}

double Bulge::linear_error(const Place &from, const Place &to, double enough) const {
  const Vector<Bezier> base = base_.pieces_between(from.on_base, to.on_base);
  const Vector<Bezier> edge = edge_.length() > 0 ? edge_.pieces_between(from.on_edge, to.on_edge) : edge_.pieces();
  const OffsetBounds bounds = bound_offset({base, edge, base_.length(), edge_.length(), to.u - from.u}, factor_);
  // Intervals overestimate |O''| several times over. So O is evaluated at a few points, and the bound on |O''| is used only
  // between neighbouring points. With eight parts, this bound contributes 64 times less.
  double error = error_between(from.u, to.u, 1, bounds.second);
  if (!(error <= enough)) error = sampled_error(from, to) + error_between(from.u, to.u, 8, bounds.second);
  return error <= bounds.largest ? error : bounds.largest;  // a NaN error also gives way to this bound
}

// Returns the largest distance of O from its linear interpolation, at the points that divide the range into eight parts.
double Bulge::sampled_error(const Place &from, const Place &to) const {
  const std::array<PointOnPiece, 7> on_base = base_.divide({from.u, from.on_base}, {to.u, to.on_base});
  const std::array<PointOnPiece, 7> on_edge = edge_.divide({from.u, from.on_edge}, {to.u, to.on_edge});
  double off_line = 0;
  for (std::size_t k = 0; k < 7; ++k) {
    const Vec3 offset = offset_at(base_, view(on_base)[k], edge_, view(on_edge)[k], factor_);
    off_line = std::max(off_line, distance(offset, mix(from.offset, to.offset, 0.125 * static_cast<double>(k + 1))));
  }
  return off_line;
}

// Bounds the error of linear interpolation between n + 1 equidistant points, by the bound on |O''|.
double Bulge::error_between(double u0, double u1, int n, double second) const {
  const double step = (u1 - u0) / n;
  double between = 0.125 * step * step * second;
  // O' may jump at a joint. The jump adds a kink of height |jump| a b / (a + b), where a and b are the distances to the
  // evaluated points before and after the joint.
  for (const double joint : joints_) {
    if (!(joint > u0 && joint < u1)) continue;
    const double behind = std::fmod(joint - u0, step);
    between += jump(joint) * behind * (step - behind) / step;
  }
  return between;
}

// Bounds the size of the jump of O' at u, which is the difference between its values on both sides.
double Bulge::jump(double u) const {
  const IntervalVector w = IntervalVector::of(edge_.at(u) - base_.at(u));
  const auto beside = [&](bool after) {
    const auto along = [&](const Curve &curve) {
      return along_end(curve.piece_beside(u, after), curve.length(), !after);
    };
    return offset_jets(w, along(base_), along(edge_), factor_);
  };
  const std::optional<OffsetJets> before = beside(false), after = beside(true);
  return before && after ? norm(after->first() - before->first()) : infinity;
}

}  // namespace riis
