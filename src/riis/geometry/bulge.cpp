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
#include "common/elementary.hpp"
#include "geometry/vec3.hpp"

namespace riis {
namespace {

// Ball arithmetic describes all values of a vector or a number by a middle value and the largest distance from it. Each operation
// gives a ball that holds every possible result. Rounding of the bounds is ignored, because it is far smaller than the bounds.

// A ball of numbers: all numbers within `radius` of `middle`.
struct Interval {
  double middle, radius;

  static Interval between(double low, double high) { return {0.5 * (low + high), 0.5 * (high - low)}; }
  double magnitude() const { return std::abs(middle) + radius; }
};

inline Interval operator+(Interval a, Interval b) { return {a.middle + b.middle, a.radius + b.radius}; }
inline Interval operator-(Interval a, Interval b) { return {a.middle - b.middle, a.radius + b.radius}; }
inline Interval operator*(double a, Interval b) { return {a * b.middle, std::abs(a) * b.radius}; }
inline Interval operator*(Interval a, Interval b) {
  return {a.middle * b.middle, std::abs(a.middle) * b.radius + a.radius * b.magnitude()};
}

// A ball of vectors: all vectors within `radius` of `middle`.
struct Ball {
  Vec3 middle;
  double radius;

  double least_length() const { return length(middle) - radius; }
  double largest_length() const { return length(middle) + radius; }
};

inline Ball operator+(const Ball &a, const Ball &b) { return {a.middle + b.middle, a.radius + b.radius}; }
inline Ball operator-(const Ball &a, const Ball &b) { return {a.middle - b.middle, a.radius + b.radius}; }
inline Ball operator*(double a, const Ball &b) { return {a * b.middle, std::abs(a) * b.radius}; }
inline Ball operator*(Interval a, const Ball &b) {
  return {a.middle * b.middle, std::abs(a.middle) * b.radius + a.radius * b.largest_length()};
}
// The radius of a ball that holds the dot products, or the cross products, of all vectors of two balls.
inline double radius_of_product(const Ball &a, const Ball &b) {
  return length(a.middle) * b.radius + a.radius * b.largest_length();
}
inline Interval dot(const Ball &a, const Ball &b) { return {dot(a.middle, b.middle), radius_of_product(a, b)}; }
inline Ball cross(const Ball &a, const Ball &b) { return {cross(a.middle, b.middle), radius_of_product(a, b)}; }
inline Interval square(const Ball &a) {
  const double least = std::max(a.least_length(), 0.0), largest = a.largest_length();
  return Interval::between(least * least, largest * largest);
}

// Inverts positive numbers.
inline Interval inverse(double least, double largest) { return Interval::between(1 / largest, 1 / least); }

// Returns the part of `a` that is perpendicular to a unit vector, for all unit vectors of the ball `unit`. Projections along two
// unit vectors differ by the sine of the angle between the vectors. This sine is at most the distance between the vectors.
inline Ball across(const Ball &a, const Ball &unit) {
  return {a.middle - dot(a.middle, unit.middle) * unit.middle, a.radius + length(a.middle) * unit.radius};
}

// Returns a ball that holds the unit vectors of all vectors in `a`. The least length in `a` must be positive. The angle between
// the middle and a vector of the ball has a sine of at most radius / length. The distance between two unit vectors is less than
// the tangent of the angle between them.
inline Ball unit(const Ball &a) {
  const double size = length(a.middle);
  return {(1 / size) * a.middle, a.radius / std::sqrt((size - a.radius) * (size + a.radius))};
}

}  // namespace

Vec3 arc_offset(Vec3 width, Vec3 along, double factor) {
  const Vec3 across = cross(width, along);
  const double size = length(across);
  return size > 0 ? (factor * length(width) / size) * across : Vec3{0, 0, 0};
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A curve's unit tangent on a range of u, with its derivatives by u, and the speed |d curve / du| there.
struct Along {
  Ball tangent, first, second;
  double speed;
};

struct Derivatives {
  explicit Derivatives(const Bezier &span) : n(static_cast<std::size_t>(span.degree)) {
    const double degree = span.degree;
    for (std::size_t i = 0; i < n; ++i) first[i] = degree * (span.control[i + 1] - span.control[i]);
    for (std::size_t i = 0; i + 1 < n; ++i) second[i] = (degree - 1) * (first[i + 1] - first[i]);
    third = n == 3 ? second[1] - second[0] : Vec3{0, 0, 0};
  }

  std::size_t n;
  std::array<Vec3, 3> first;
  std::array<Vec3, 2> second;
  Vec3 third;
};

// Returns the tangent from B'' and B''', the derivatives of a Bézier span by its own parameter t. The size of B' is between
// `least` and `largest`. An underscore marks a part at right angles to T. With dt/du = speed / |B'|, the derivatives of T by u
//   are T' = speed / |B'|^2 B''_ and T'' = speed^2 / |B'|^3 (B'''_ - 3 (T.B'') / |B'| B''_ - |B''_|^2 / |B'| T).
Along along(const Ball &tangent, double least, double largest, const Ball &second, Vec3 third, double speed) {
  const Interval inverse_size = inverse(least, largest);
  const Interval inverse_size_sq = Interval::between(1 / (largest * largest), 1 / (least * least));
  const Ball bend = across(second, tangent);
  const Ball of_third = across({third, 0}, tangent) - (3 * inverse_size * dot(tangent, second)) * bend -
                        (inverse_size * square(bend)) * tangent;
  return {tangent, speed * (inverse_size_sq * bend), (speed * speed) * (inverse_size * inverse_size_sq * of_third),
          speed};
}

// Returns the tangent over a whole span, or nothing if B' may be 0 inside the span. The speed is 0 if the curve is a point.
std::optional<Along> along_span(const Bezier &span, double speed) {
  if (!(speed > 0)) return Along{};
  const Derivatives d(span);
  const bool is_cubic = d.n == 3;
  // `middle` is B' in the middle of the span. B' changes from there to either end by the integral of B'' over half of the range
  // of t.
  const Vec3 middle = is_cubic ? 0.25 * (d.first[0] + 2 * d.first[1] + d.first[2]) : 0.5 * (d.first[0] + d.first[1]);
  const double size = length(middle);
  if (!(size > 0)) return std::nullopt;
  const Vec3 direction = (1 / size) * middle;
  double ahead = 0, sideways = 0;
  for (std::size_t i = 0; i + 1 < d.n; ++i) {
    const double by = dot(d.second[i], direction);
    ahead = std::max(ahead, 0.5 * std::abs(by));
    sideways = std::max(sideways, 0.5 * length(d.second[i] - by * direction));
  }
  const double least = size - ahead, largest = hypotenuse(size + ahead, sideways);
  if (!(least > 0)) return std::nullopt;
  const Ball second = is_cubic ? Ball{0.5 * (d.second[0] + d.second[1]), 0.5 * length(d.third)} : Ball{d.second[0], 0};
  return along({direction, sideways / least}, least, largest, second, d.third, speed);
}

// Returns the tangent at the start or the end of a span, or nothing if B' is 0 there.
std::optional<Along> along_end(const Bezier &span, double speed, bool at_end) {
  if (!(speed > 0)) return Along{};
  const Derivatives d(span);
  const Vec3 first = d.first[at_end ? d.n - 1 : 0];
  const double size = length(first);
  if (!(size > 0)) return std::nullopt;
  return along({(1 / size) * first, 0}, size, size, {d.second[at_end ? d.n - 2 : 0], 0}, d.third, speed);
}

// The derivatives of O (bulge.hpp) by u, computed from W and from both tangents.
class OffsetDerivatives {
 public:
  OffsetDerivatives(const Ball &w, const Along &base, const Along &edge, double factor)
      : w_(w), base_(base), edge_(edge), factor_(factor) {
    // E is the edge's tangent, and l and a are the speeds, so W' = l E - a T. M = W x T has the derivative M' = l E x T + W x T'.
    // The product T x T is left out. This product is 0, but the product of two balls would not be 0.
    m_ = cross(w, base.tangent);
    if (!(m_.least_length() > 0)) return;
    has_direction_ = true;
    const Ball to_edge = edge.speed * edge.tangent;
    m1_ = cross(to_edge, base.tangent) + cross(w, base.first);
    w1_ = to_edge - base.speed * base.tangent;
    normal_ = unit(m_);
    along_ = unit(w);
    m_inverse_ = inverse(m_.least_length(), m_.largest_length());
    w_size_ = Interval::between(std::max(w.least_length(), m_.least_length()), w.largest_length());
    size1_ = dot(along_, w1_);
    across1_ = across(m1_, normal_);
  }

  // Returns whether O has a direction. This is so if W is nowhere parallel to T.
  bool has_direction() const { return has_direction_; }

  // O is factor |W| N with N = M / |M|, and N' is the part of M' across N, divided by |M|.
  Ball first() const { return factor_ * (size1_ * normal_ + (w_size_ * m_inverse_) * across1_); }

  // Bounds |O''|. The part along N and the part across N are bounded separately: O'' / factor = (|W|'' - |W| |N'|^2) N + (2 (|W|'
  // - |W| (N.M') / |M|) M'_across + |W| M''_across) / |M|.
  double largest_second() const {
    const Ball w2 = edge_.speed * edge_.first - base_.speed * base_.first;
    const Ball m2 = edge_.speed * (cross(edge_.first, base_.tangent) + 2 * cross(edge_.tangent, base_.first)) -
                    base_.speed * cross(base_.tangent, base_.first) + cross(w_, base_.second);
    const Interval w_inverse = inverse(w_size_.middle - w_size_.radius, w_size_.middle + w_size_.radius);
    const Interval size2 = w_inverse * square(across(w1_, along_)) + dot(along_, w2);
    const Interval turn = m_inverse_ * m_inverse_ * square(across1_);
    const Interval along_normal = size2 - w_size_ * turn;
    const Interval rate = size1_ - w_size_ * m_inverse_ * dot(normal_, m1_);
    const Ball across_normal = m_inverse_ * (2 * rate * across1_ + w_size_ * across(m2, normal_));
    const double bound = std::abs(factor_) * hypotenuse(along_normal.magnitude(), across_normal.largest_length());
    return bound >= 0 ? bound : infinity;  // the bound is NaN if numbers beyond the range of doubles cancelled
  }

 private:
  Ball w_;
  const Along &base_, &edge_;
  double factor_;
  bool has_direction_ = false;
  Ball m_, m1_, w1_, normal_, along_, across1_;
  Interval m_inverse_, w_size_, size1_;
};

// Returns O between two points of base and edge. Both points lie at the same fraction of the length along their curves.
Vec3 offset_at(const Curve &base, const PointOnSpan &on_base, const Curve &edge, const PointOnSpan &on_edge,
               double factor) {
  const Curve::PointAndTangent there = base.with_tangent(on_base);
  return arc_offset(edge.at(on_edge) - there.point, there.tangent, factor);
}

}  // namespace

Bulge::Bulge(Curve base, Curve edge, double factor) : base_(std::move(base)), edge_(std::move(edge)), factor_(factor) {
  const Vector<double> of_base = base_.joints(), of_edge = edge_.joints();
  std::merge(of_base.begin(), of_base.end(), of_edge.begin(), of_edge.end(), std::back_inserter(joints_));
}

Bulge::Place Bulge::place(double u) const {
  const PointOnSpan on_base = base_.on_span(u), on_edge = edge_.on_span(u);
  return {u, on_base, on_edge, offset_at(base_, on_base, edge_, on_edge, factor_)};
}

OffsetBounds bound_offset(const ArcRange &range, double factor) {
  const Vec3 start = range.edge.front().first() - range.base.front().first();
  const Vec3 end = range.edge.back().last() - range.base.back().last();
  // From one end of the range to the other, a point moves along each curve by the length of the curve's part. W therefore differs
  // from the nearer one of its two end values by at most half the sum of the two parts' lengths.
  const double w_ends = std::max(length(start), length(end));
  const double w_far = w_ends + 0.5 * range.du * (range.base_length + range.edge_length);
  const OffsetBounds unknown{infinity, 2 * std::abs(factor) * w_far};

  Vector<Along> along_base, along_edge;
  const auto add = [](const Vector<Bezier> &spans, double speed, Vector<Along> &to) {
    to.reserve(spans.size());
    for (const Bezier &span : spans) {
      const std::optional<Along> made = along_span(span, speed);
      if (!made) return false;
      to.push_back(*made);
    }
    return true;
  };
  if (!add(range.base, range.base_length, along_base) || !add(range.edge, range.edge_length, along_edge))
    return unknown;

  // W stays near the line between its two end values. The largest bend over all pairs of spans bounds the distance from this
  // line.
  double bend = 0;
  for (const Along &b : along_base)
    for (const Along &e : along_edge) bend = std::max(bend, (e.speed * e.first - b.speed * b.first).largest_length());
  const double off_line = 0.125 * range.du * range.du * bend;
  const Ball w{0.5 * (start + end), 0.5 * distance(start, end) + off_line};

  double second = 0;
  for (const Along &b : along_base)
    for (const Along &e : along_edge) {
      const OffsetDerivatives offset(w, b, e, factor);
      second = std::max(second, offset.has_direction() ? offset.largest_second() : infinity);
    }
  // Both |O| and the length of its linear interpolation are at most |factor| |W|.
  return {second, 2 * std::abs(factor) * std::min(w_ends + off_line, w_far)};
}

double Bulge::linear_error(const Place &from, const Place &to, double enough) const {
  const Vector<Bezier> base = base_.spans_between(from.on_base, to.on_base);
  const Vector<Bezier> edge = edge_.length() > 0 ? edge_.spans_between(from.on_edge, to.on_edge) : edge_.spans();
  const OffsetBounds bounds = bound_offset({base, edge, base_.length(), edge_.length(), to.u - from.u}, factor_);
  // If the bound on |O''| is too large, O is evaluated at a few points, and the bound is used only between neighbouring points.
  // With eight parts, the error from the bound is only 1/64 of the error for the whole range.
  double error = error_between(from.u, to.u, 1, bounds.second);
  if (!(error <= enough)) error = sampled_error(from, to) + error_between(from.u, to.u, 8, bounds.second);
  return error <= bounds.largest ? error : bounds.largest;  // this bound is also returned if the error is NaN
}

// Returns the largest distance of O from its linear interpolation, at the points that divide the range into eight parts.
double Bulge::sampled_error(const Place &from, const Place &to) const {
  const std::array<PointOnSpan, 7> on_base = base_.divide({from.u, from.on_base}, {to.u, to.on_base});
  const std::array<PointOnSpan, 7> on_edge = edge_.divide({from.u, from.on_edge}, {to.u, to.on_edge});
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
  // O' may jump at a joint. The nearest evaluated points before and after the joint are at the distances a and b from the joint.
  // The jump adds a kink of height |jump| a b / (a + b).
  for (const double joint : joints_) {
    if (!(joint > u0 && joint < u1)) continue;
    const double behind = std::fmod(joint - u0, step);
    between += jump(joint) * behind * (step - behind) / step;
  }
  return between;
}

// Bounds the jump of O' at u: the difference between its values just before and just after u.
double Bulge::jump(double u) const {
  const Ball w{edge_.at(u) - base_.at(u), 0};
  Ball first[2];
  for (const bool after : {false, true}) {
    const std::optional<Along> base = along_end(base_.span_beside(u, after), base_.length(), !after);
    const std::optional<Along> edge = along_end(edge_.span_beside(u, after), edge_.length(), !after);
    if (!base || !edge) return infinity;
    const OffsetDerivatives offset(w, *base, *edge, factor_);
    if (!offset.has_direction()) return infinity;
    first[after ? 1 : 0] = offset.first();
  }
  const double size = (first[1] - first[0]).largest_length();
  return size >= 0 ? size : infinity;
}

}  // namespace riis
