// SPDX-License-Identifier: Apache-2.0
#include "geometry/curve.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/errors.hpp"
#include "common/array_view.hpp"

namespace riis {
namespace {

// A curve has at most 2^20 parts, because more parts would make more triangles than the library can hold.
constexpr int max_depth = 20;
// Only parts wider than `narrowest_for_velocity` are halved because of their velocity. Otherwise halving would not end where a
// curve's derivative is nearly 0.
constexpr double narrowest_for_velocity = 1.0 / 32;

// Collects the chords of parts. Each part is within max_error of its chord.
class Flattening {
 public:
  // The list begins with the curve's first point. `bend` is null if the velocity does not matter.
  Flattening(Vec3 first, double max_error, const VelocityBend *bend, double max_bend)
      : max_error_(max_error), bend_(bend), max_bend_(max_bend) {
    constexpr std::size_t usual = 16;  // most curves of a valve have fewer points
    flattened_.points.reserve(usual);
    flattened_.t.reserve(usual);
    flattened_.errors.reserve(usual);
    flattened_.points.push_back(first);
    flattened_.t.push_back(0);
  }

  // Adds a part of one span. The part goes from the fraction t0 to the fraction t1 of the whole curve's length.
  void add(const Bezier &part, double part_length, double t0, double t1, int depth) {
    const double distance_to_chord = flatness(part) * (part.degree == 2 ? 0.5 : 0.75);
    if (!is_bent(t0, t1) &&
        accept(
            part.last(), distance_to_chord, part_length, [&] { return largest_curvature(part); }, t1))
      return;
    check(depth);
    const auto [left, right] = split(part, parameter_at_length(part, part_length, 0.5 * part_length));
    const double middle = 0.5 * (t0 + t1);
    add(left, 0.5 * part_length, t0, middle, depth + 1);
    add(right, 0.5 * part_length, middle, t1, depth + 1);
  }

  // Adds a part of one or several spans. The part goes from the fraction t0 to the fraction t1 of the whole curve's length.
  void add(const Curve &part, double t0, double t1, int depth) {
    const Vector<Bezier> &spans = part.spans();
    if (spans.size() == 1) {
      add(spans.front(), part.length(), t0, t1, depth);
      return;
    }
    const auto curvature = [&] {
      double largest = 0;
      for (const Bezier &span : spans) largest = std::max(largest, largest_curvature(span));
      return largest;
    };
    if (!is_bent(t0, t1) && accept(part.last(), distance_to_chord(part), part.length(), curvature, t1)) return;
    check(depth);
    const double middle = 0.5 * (t0 + t1);
    add(part.between(0, 0.5), t0, middle, depth + 1);
    add(part.between(0.5, 1), middle, t1, depth + 1);
  }

  Flattened take() { return std::move(flattened_); }

 private:
  bool is_bent(double t0, double t1) const {
    return bend_ && t1 - t0 > narrowest_for_velocity && bend_->off_linear(t0, t1) > max_bend_;
  }

  // The error of a part is the largest distance between part and chord at equal shares of their lengths. As for linear
  // interpolation, this error is at most length^2 / 8 times the largest curvature. Joints do not change this bound, because the
  // direction is continuous there. If the curve's derivative may be 0, the length bounds the error.
  template <class LargestCurvature>
  bool accept(Vec3 last, double distance_to_chord, double part_length, const LargestCurvature &largest_curvature,
              double t1) {
    if (!(distance_to_chord <= max_error_)) return false;
    const double error = std::min(part_length, 0.125 * part_length * part_length * largest_curvature());
    if (!(error <= max_error_)) return false;
    flattened_.points.push_back(last);
    flattened_.t.push_back(t1);
    flattened_.errors.push_back(error);
    return true;
  }

  void check(int depth) const {
    if (depth == max_depth)
      fail(RIIS_LIMIT_EXCEEDED, "a curve needs more than ", 1 << max_depth, " points to be accurate to ", max_error_,
           ": tolerance * half_thickness is too small for it");
  }

  // No point of a Bézier curve is farther from a segment than the farthest control point of the curve.
  static double distance_to_chord(const Curve &part) {
    double largest = 0;
    for (const Bezier &span : part.spans())
      for (int i = 0; i <= span.degree; ++i)
        largest = std::max(largest, flatness(Bezier::quadratic(part.first(), view(span.control)[i], part.last())));
    return largest;
  }

  double max_error_;
  const VelocityBend *bend_;
  double max_bend_;
  Flattened flattened_;
};

}  // namespace

Curve::Curve(const Bezier &span) : spans_{span}, ends_{arc_length(span)} {}

Curve::Curve(Vector<Bezier> spans) : spans_(std::move(spans)) {
  double end = 0;
  for (const Bezier &span : spans_) ends_.push_back(end += arc_length(span));
}

Vector<double> Curve::joints() const {
  Vector<double> shares;
  for (std::size_t i = 0; i + 1 < ends_.size(); ++i) shares.push_back(ends_[i] / length());
  return shares;
}

PointOnSpan Curve::on_span(double share) const {
  if (share >= 1 || !(length() > 0)) return {spans_.size() - 1, 1};
  const double behind = std::max(share, 0.0) * length();
  // A point at a joint belongs to the later span, even if rounding puts it slightly before the joint.
  std::size_t span = 0;
  while (span + 1 < spans_.size() && behind >= ends_[span] - negligible_share * length()) ++span;
  const double start = span == 0 ? 0 : ends_[span - 1];
  if (behind <= start + negligible_share * length()) return {span, 0};
  return {span, parameter_at_length(spans_[span], length(span), behind - start)};
}

std::array<PointOnSpan, 7> Curve::divide(const Place &from, const Place &to) const {
  std::array<PointOnSpan, 7> points;
  std::array<double, 7> t;
  const std::size_t span = from.where.span;
  const double part = to.share - from.share, end = to.where.span == span ? to.where.t : 1;
  const bool is_one_span = to.where.span == span || (to.where.span == span + 1 && to.where.t == 0);
  if (is_one_span && divide_part(spans_[span], length(), from.where.t, end, part * length(), t))
    for (std::size_t k = 0; k < 7; ++k) view(points)[k] = {span, view(t)[k]};
  else
    for (std::size_t k = 0; k < 7; ++k)
      view(points)[k] = on_span(from.share + 0.125 * static_cast<double>(k + 1) * part);
  return points;
}

Curve::PointAndTangent Curve::with_tangent(const PointOnSpan &where) const {
  const Bezier &span = spans_[where.span];
  const Vec3 along = derivative(span, where.t);
  const double speed = riis::length(along);
  return {evaluate(span, where.t), speed > 0 ? (1.0 / speed) * along : Vec3{0, 0, 0}};
}

Bezier Curve::span_beside(double share, bool after) const {
  const PointOnSpan where = on_span(share);
  const Bezier &span = spans_[where.span];
  if (after) return where.t > 0 ? split(span, where.t).second : span;
  if (where.t == 0 && where.span > 0) return spans_[where.span - 1];
  return where.t < 1 ? split(span, where.t).first : span;
}

Vector<Bezier> Curve::spans_between(const PointOnSpan &from, const PointOnSpan &to) const {
  Vector<Bezier> part;
  for (std::size_t i = from.span; i <= to.span; ++i) {
    if (i == to.span && to.t == 0 && i > from.span) break;
    Bezier span = spans_[i];
    if (i == to.span && to.t < 1) span = split(span, to.t).first;
    if (i == from.span && from.t > 0) span = split(span, i == to.span ? from.t / to.t : from.t).second;
    part.push_back(span);
  }
  return part;
}

Curve Curve::reversed() const {
  Vector<Bezier> spans = spans_;
  reverse(spans);
  return Curve(std::move(spans));
}

Curve Curve::through(Vec3 first, Vec3 last) const {
  Curve moved = *this;
  moved.spans_.front().control[0] = first;
  Bezier &last_span = moved.spans_.back();
  view(last_span.control)[last_span.degree] = last;
  return moved;
}

void reverse(Vector<Bezier> &spans) {
  std::reverse(spans.begin(), spans.end());
  for (Bezier &span : spans) span = span.reversed();
}

bool are_equal(const Curve &a, const Curve &b) {
  return std::equal(
      a.spans().begin(), a.spans().end(), b.spans().begin(), b.spans().end(), [](const Bezier &p, const Bezier &q) {
        const auto n = static_cast<std::ptrdiff_t>(p.degree) + 1;
        return p.degree == q.degree && std::equal(p.control.begin(), p.control.begin() + n, q.control.begin());
      });
}

VelocityBend::VelocityBend(const Curve &curve, const Vector<Bezier> &velocity) {
  struct Sample {
    Vec3 first, second, third, tangent, rate_first, rate_second;
    double speed;
    double behind, rate_behind;  // the length from the curve's start to this point, and its rate
  };
  Vector<std::array<Sample, n_cells + 1>> spans;
  double total = 0, rate_total = 0;
  for (std::size_t span = 0; span < velocity.size(); ++span) {
    spans.emplace_back();
    auto &samples = spans.back();
    for (std::size_t k = 0; k <= n_cells; ++k) {
      const double t = static_cast<double>(k) / n_cells;
      const auto [d1, d2, d3] = derivatives(curve.spans()[span], t);
      const auto [r1, r2, r3] = derivatives(velocity[span], t);
      const double speed = riis::length(d1);
      view(samples)[k] = {d1, d2, d3, speed > 0 ? (1 / speed) * d1 : Vec3{0, 0, 0}, r1, r2, speed, total, rate_total};
    }
    constexpr double half_step = 0.5 / n_cells;
    for (std::size_t k = 1; k <= n_cells; ++k) {
      const Sample &from = view(samples)[k - 1];
      Sample &to = view(samples)[k];
      to.behind = from.behind + half_step * (from.speed + to.speed);
      to.rate_behind =
          from.rate_behind + half_step * (dot(from.tangent, from.rate_first) + dot(to.tangent, to.rate_first));
    }
    total = samples.back().behind, rate_total = samples.back().rate_behind;
  }
  const double curve_length = curve.length();
  const auto bend_at = [&](const Sample &at, double u) {
    if (!(at.speed > 0)) return 0.0;
    // While the curve moves, the parameter of the point at a fixed share u of the length changes at this rate.
    const double t_rate = -(at.rate_behind - u * rate_total) / at.speed;
    const Vec3 first_rate = at.rate_first + t_rate * at.second, second_rate = at.rate_second + t_rate * at.third;
    const double speed_rate = dot(at.tangent, first_rate), inverse = 1 / at.speed;
    const Vec3 tangent_rate = inverse * (first_rate - speed_rate * at.tangent);
    const double along = dot(at.tangent, at.second);
    // The curvature vector and its rate of change with the opening. The curvature vector times the squared length of the curve is
    // the second derivative of the point with respect to the share.
    const Vec3 curvature = inverse * inverse * (at.second - along * at.tangent);
    const Vec3 curvature_rate = inverse * inverse *
                                    (second_rate - along * tangent_rate -
                                     (dot(tangent_rate, at.second) + dot(at.tangent, second_rate)) * at.tangent) -
                                2 * inverse * speed_rate * curvature;
    return riis::length(2 * curve_length * rate_total * curvature + curve_length * curve_length * curvature_rate);
  };
  for (std::size_t span = 0; span < spans.size(); ++span) {
    const bool is_last = span + 1 == spans.size();
    double u0 = 0, bend0 = 0;
    for (std::size_t k = 0; k <= n_cells; ++k) {
      const Sample &at = view(spans[span])[k];
      const double u = is_last && k == n_cells ? 1 : at.behind / total, bend = bend_at(at, u);
      if (k > 0) cells_.push_back({u0, u, bend0, bend});
      u0 = u, bend0 = bend;
    }
  }
}

double VelocityBend::off_linear(double u0, double u1) const {
  double largest = 0;
  for (const Cell &cell : cells_)
    if (cell.u0 < u1 && cell.u1 > u0)
      largest = std::max({largest, cell.at(std::max(u0, cell.u0)), cell.at(std::min(u1, cell.u1))});
  return 0.125 * (u1 - u0) * (u1 - u0) * largest;
}

Flattened flatten(const Curve &curve, double max_error, const VelocityBend *bend, double max_bend) {
  Flattening flattening(curve.first(), max_error, bend, max_bend);
  if (curve.length() > 0) flattening.add(curve, 0, 1, 0);
  return flattening.take();
}

namespace {

// Returns the part of a span between the parameters t0 and t1.
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
    // A share at a joint belongs to the later span, even if rounding puts it slightly before the joint.
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
    // If the part ends at the start of a span, it contains nothing of this span.
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

Polyline make_polyline(const Vector<Vec3> &points) {
  Polyline polyline{{points.front()}, {0.0}, {}, 0.0};
  for (const Vec3 &point : points) {
    const double step = distance(polyline.points.back(), point);
    // If a step is too short to change the sum, its two ends would have the same t. The second end is therefore left out.
    if (!(polyline.length + step > polyline.length)) continue;
    polyline.length += step;
    polyline.points.push_back(point);
    polyline.t.push_back(polyline.length);
    polyline.errors.push_back(0.0);
  }
  if (polyline.length > 0) {
    // Neighbouring curves share the last point, so the polyline ends exactly there, even if the loop left this point out.
    polyline.points.back() = points.back();
    for (double &t : polyline.t) t /= polyline.length;
  }
  return polyline;
}

namespace {

Polyline polyline_of(Flattened flattened, const Curve &curve) {
  return {std::move(flattened.points), std::move(flattened.t), std::move(flattened.errors), curve.length()};
}

}  // namespace

Polyline make_polyline(const Curve &curve, double max_error) { return polyline_of(flatten(curve, max_error), curve); }

Polyline make_polyline(const Curve &curve, double max_error, const Vector<Bezier> &velocity, double max_bend) {
  if (!(curve.length() > 0)) return make_polyline(curve, max_error);
  const VelocityBend bend(curve, velocity);
  return polyline_of(flatten(curve, max_error, &bend, max_bend), curve);
}

Polyline reversed(const Polyline &polyline) {
  Polyline turned{{polyline.points.rbegin(), polyline.points.rend()},
                  {polyline.t.rbegin(), polyline.t.rend()},
                  {polyline.errors.rbegin(), polyline.errors.rend()},
                  polyline.length};
  if (polyline.length > 0)
    for (double &t : turned.t) t = 1 - t;
  return turned;
}

Vec3 evaluate(const Polyline &polyline, double t) {
  const auto after = std::upper_bound(polyline.t.begin(), polyline.t.end(), t);
  if (after == polyline.t.end()) return polyline.points.back();
  if (after == polyline.t.begin()) return polyline.points.front();
  const std::int64_t i = after - polyline.t.begin();
  const double t0 = view(polyline.t)[i - 1], t1 = view(polyline.t)[i];
  return mix(view(polyline.points)[i - 1], view(polyline.points)[i], (t - t0) / (t1 - t0));
}

}  // namespace riis
