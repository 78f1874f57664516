// SPDX-License-Identifier: Apache-2.0
#include "velocity_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <utility>

#include "api/handles.hpp"
#include "api/surface_options.hpp"
#include "geometry/curve.hpp"
#include "motion/displacement.hpp"

namespace riis {
namespace {

// The two states from which the velocities were computed.
struct TwoStates {
  const PatchSet &now;
  PatchSet before;
  Placement placement, placement_before;
  double seconds;
};

constexpr double infinity = std::numeric_limits<double>::infinity();

// Bounds of a quantity on a range of u. `size` bounds the quantity's length in both states. `change` bounds how much the quantity
// differs between the states at equal u. The rule for products also holds for dot products and cross products.
struct Both {
  double size, change;
};
Both operator+(Both a, Both b) { return {a.size + b.size, a.change + b.change}; }
Both operator*(Both a, Both b) { return {a.size * b.size, a.change * b.size + a.size * b.change}; }
Both operator*(double a, Both b) { return {a * b.size, a * b.change}; }

// Limits for halving ranges: the number of rounds, the number of ranges, and the width of a range.
constexpr int most_rounds = 12;
constexpr std::size_t most_ranges = 1024;
constexpr double narrow = 2e-5;

// The bounds on a range are tight if the least length on the range is at least this share of the largest length.
constexpr double tight_share = 0.9;

// Bounds the inverse of a length that is at least `least`.
Both inverse(double least, double change) { return {1 / least, change / (least * least)}; }

// Returns NaN if a or b is NaN, for example from 0 times infinity. A bound of NaN means that no bound is known.
double larger(double a, double b) { return a >= b || a != a ? a : b; }
double larger_of(Vec3 a, Vec3 b) { return larger(length(a), length(b)); }

// Returns the least distance from the origin to the segment between two points.
double least_on_segment(Vec3 a, Vec3 b) {
  const Vec3 along = b - a;
  const double size_sq = dot(along, along);
  const double share = size_sq > 0 ? std::clamp(-dot(a, along) / size_sq, 0.0, 1.0) : 0;
  return length(mix(a, b, share));
}

// Bounds the distance of a function from the straight line between its ends. The function's second derivative is at most
// `second`.
double off_line(double width, double second) { return 0.125 * width * width * second; }

// The width of a range of u, and the largest slope of a function on it.
struct Slope {
  double width, most;
};

// Bounds the distance of a continuous function from the straight line between its ends. Bounds of the function's slope on
// successive ranges are given. For the bound at x, each slope has a weight. Before x, the weight is the share of the whole width
// that lies after x. After x, the weight is the share that lies before x. If one slope holds everywhere, the bound is half the
// width times the slope. A steep slope on a narrow range adds little.
double off_line(const Vector<Slope> &slopes) {
  double width = 0, rise = 0;
  for (const Slope &on : slopes) width += on.width, rise += on.width * on.most;
  double largest = 0, start = 0, before = 0;
  for (const auto &[range, most] : slopes) {
    // Within a range, the bound is a concave parabola in x.
    const double top = (rise - 2 * before + most * (2 * start + width)) / (4 * most);
    const double x = top >= start ? std::min(top, start + range) : start, behind = before + most * (x - start);
    largest = larger(largest, (1 - x / width) * behind + x / width * (rise - behind));
    start += range;
    before += range * most;
  }
  return largest;
}

// The part of a Bézier span that belongs to a range of u.
struct CurvePart {
  const Bezier *span;
  double t[2];
  double length;  // the length of the whole curve
};

// Bounds for a curve on a range of u: its length, its unit tangent, and the tangent's first and second derivative with respect to
// u.
struct AlongCurve {
  Both length, value, first, second;
  double size_now, size_before;  // bounds of the curve's second derivative with respect to u, in each state
  bool is_tight;                 // false if a narrower range would have much better bounds
  Both second_of_point() const { return length * first; }
};

// Bounds on the lengths of a curve's derivatives in one state, on a range of the curve's parameter.
struct Derivatives {
  double first, least_first, second, third;
};

Derivatives sizes_on(const Bezier &span, double from, double to) {
  const auto start = derivatives(span, from), end = derivatives(span, to);
  const double bend = off_line(to - from, length(start[2]));
  return {larger_of(start[0], end[0]) + bend, least_on_segment(start[0], end[0]) - bend, larger_of(start[1], end[1]),
          length(start[2])};
}

// Bounds the differences between the derivatives of two spans at the same parameter.
Derivatives changes_on(const Bezier &now, const Bezier &before, double from, double to) {
  const auto start = derivatives(now, from), end = derivatives(now, to);
  const auto start_before = derivatives(before, from), end_before = derivatives(before, to);
  const double third = distance(start[2], start_before[2]);
  return {larger(distance(start[0], start_before[0]), distance(end[0], end_before[0])) + off_line(to - from, third), 0,
          larger(distance(start[1], start_before[1]), distance(end[1], end_before[1])), third};
}

// Bounds a curve on a range. The bounds are infinite if the tangent may vanish in one of the two states.
AlongCurve along(const CurvePart &at_now, const CurvePart &at_before, double width) {
  const double from = std::min(at_now.t[0], at_before.t[0]), to = std::max(at_now.t[1], at_before.t[1]);
  const Derivatives now = sizes_on(*at_now.span, from, to), before = sizes_on(*at_before.span, from, to);
  const double least = std::min(now.least_first, before.least_first), first = larger(now.first, before.first),
               second = larger(now.second, before.second), third = larger(now.third, before.third);
  const double whole = larger(at_now.length, at_before.length);
  const Both length{whole, std::abs(at_now.length - at_before.length)};
  if (!(least > 0)) {
    const Both unknown{infinity, infinity};
    return {length, unknown, unknown, unknown, infinity, infinity, false};
  }
  // At equal u, the parameters of the two states differ by at most `shift`. `shift` is the difference at the ends of the range,
  // plus the largest growth between the ends at the rates dt/du = length / |B'|.
  const Derivatives change = changes_on(*at_now.span, *at_before.span, from, to);
  const double at_ends = larger(std::abs(at_now.t[0] - at_before.t[0]), std::abs(at_now.t[1] - at_before.t[1]));
  const double half = 0.5 * width, rate_change = length.change / least + whole * change.first / (least * least);
  const double by_itself = half * whole * second / (least * least);
  const double shift =
      by_itself < 1 ? std::min((at_ends + half * rate_change) / (1 - by_itself), to - from) : to - from;
  const Both d1{first, change.first + second * shift}, d2{second, change.second + third * shift},
      d3{third, change.third};
  const Both inverse_speed = inverse(least, d1.change), t_first = length * inverse_speed;
  const Both tangent{1, d1.change / least}, across{1, tangent.change};  // `across` bounds the projection along the
                                                                        // tangent
  const Both inverse_sq = inverse_speed * inverse_speed;
  const Both bent = length * inverse_sq * across * d2;
  const Both inverse_speed_first = inverse_sq * tangent * d2 * t_first;
  const Both across_first{bent.size, 2 * (bent.change + bent.size * tangent.change)};
  const Both on_second = 2 * inverse_speed * inverse_speed_first * across * d2 + inverse_sq * across_first * d2 +
                         inverse_sq * across * d3 * t_first;
  return {length,
          tangent,
          bent,
          length * on_second,
          at_now.length * at_now.length * now.second / (now.least_first * now.least_first),
          at_before.length * at_before.length * before.second / (before.least_first * before.least_first),
          least >= tight_share * first && by_itself <= 1 - tight_share};
}

// Bounds both states separately, and combines the bounds. The result serves a range on which the states lie on different spans,
// so that they cannot be compared.
AlongCurve either(const AlongCurve &now, const AlongCurve &before) {
  const auto of = [](Both a, Both b) { return Both{larger(a.size, b.size), a.size + b.size}; };
  return {of(now.length, before.length),
          of(now.value, before.value),
          of(now.first, before.first),
          of(now.second, before.second),
          now.size_now,
          before.size_now,
          now.is_tight && before.is_tight};
}

// Returns 1 if `curve` has one span more than `other`, and the additional span is at the start. Of the two end spans of `curve`,
// the shorter span is the additional one.
std::size_t more_at_start(const Curve &curve, const Curve &other) {
  const std::size_t n = curve.spans().size();
  return n == other.spans().size() + 1 && curve.length(0) < curve.length(n - 1) ? 1 : 0;
}

// A side of a patch in both states, divided at ascending shares of its length. The shares include the joints between spans.
class SideInBoth {
 public:
  SideInBoth(const Curve &now, const Curve &before, const Vector<double> &shares)
      : now_(now),
        before_(before),
        shares_(shares),
        at_now_(now, false, shares),
        at_before_(before, false, shares),
        more_now_(more_at_start(now, before)),
        more_before_(more_at_start(before, now)) {}

  Vec3 now(std::size_t i) const { return at_now_.point(i); }
  Vec3 before(std::size_t i) const { return at_before_.point(i); }
  Vec3 tangent_now(std::size_t i) const { return at_now_.tangent(i); }
  Vec3 tangent_before(std::size_t i) const { return at_before_.tangent(i); }
  const Curve &curve_now() const { return now_; }
  const Curve &curve_before() const { return before_; }
  double longer() const { return larger(now_.length(), before_.length()); }
  double width(std::size_t i) const { return shares_[i + 1] - shares_[i]; }

  // Returns whether the states are compared on the range after share i. There is no comparison if a joint has passed through the
  // range, or if the range is narrow and has no tight bounds. Narrow ranges without tight bounds lie on a short span at a curve's
  // end. When a joint approaches the end, the length of this span changes by a large factor.
  bool is_compared(std::size_t i) const { return are_on_one_span(i) && (width(i) > narrow || compared(i).is_tight); }

  // Returns whether a span begins at share i in one of the states.
  bool is_joint(std::size_t i) const {
    return at_now_.span(i) != at_now_.span(i - 1) || at_before_.span(i) != at_before_.span(i - 1);
  }

  AlongCurve between(std::size_t i) const {
    if (!(now_.length() > 0) && !(before_.length() > 0)) {
      const Both none{0, 0};
      return {none, none, none, none, 0, 0, true};
    }
    if (are_on_one_span(i)) {
      const AlongCurve made = compared(i);
      if (width(i) > narrow || made.is_tight) return made;
    }
    const CurvePart now = part(at_now_, now_, i), before = part(at_before_, before_, i);
    return either(along(now, now, width(i)), along(before, before, width(i)));
  }

 private:
  // Returns whether both states lie on the same span in the range after share i.
  bool are_on_one_span(std::size_t i) const { return at_now_.span(i) + more_before_ == at_before_.span(i) + more_now_; }

  AlongCurve compared(std::size_t i) const {
    return along(part(at_now_, now_, i), part(at_before_, before_, i), width(i));
  }

  // Returns the part of a Bézier span that belongs to the range after share i.
  CurvePart part(const CurvePoints &points, const Curve &curve, std::size_t i) const {
    const std::size_t span = points.span(i);
    return {&curve.spans()[span],
            {points.parameter(i), points.span(i + 1) == span ? points.parameter(i + 1) : 1.0},
            curve.length()};
  }

  const Curve &now_, &before_;
  const Vector<double> &shares_;
  CurvePoints at_now_, at_before_;
  // Each number is 1 if its state has an additional span at the start, because a joint passed this end of the curve. Otherwise
  // the number is 0.
  std::size_t more_now_, more_before_;
};

void add_joints(const Curve &curve, Vector<double> &shares) {
  for (const double joint : curve.joints()) shares.push_back(joint);
}

// The lines of a grid, and the joints of curves between the lines. A range is halved if it is too wide for tight bounds.
class Shares {
 public:
  Shares(const Vector<double> &lines, std::initializer_list<const Curve *> curves) : lines_(lines), all_(lines) {
    for (const Curve *curve : curves) add_joints(*curve, all_);
    std::sort(all_.begin(), all_.end());
    all_.erase(std::unique(all_.begin(), all_.end(), [](double a, double b) { return b - a <= 4 * negligible_share; }),
               all_.end());
    all_.back() = 1;
  }

  const Vector<double> &all() const { return all_; }
  // Returns the position of line k in all().
  std::size_t line(std::size_t k) const {
    const auto found = std::lower_bound(all_.begin(), all_.end(), lines_[k] - 4 * negligible_share);
    return static_cast<std::size_t>(found - all_.begin());
  }

  // Halves the ranges for which is_tight(i) is false. Does not halve narrow ranges. Returns whether a range was halved. Also
  // returns false if there are too many ranges, which happens for a curve whose bounds never become tight.
  template <class IsTight>
  bool halve(const IsTight &is_tight) {
    if (all_.size() > 2 * most_ranges) return false;
    Vector<double> made;
    for (std::size_t i = 0; i + 1 < all_.size(); ++i) {
      made.push_back(all_[i]);
      if (all_[i + 1] - all_[i] > narrow && !is_tight(i)) made.push_back(0.5 * (all_[i] + all_[i + 1]));
    }
    made.push_back(1);
    std::swap(made, all_);
    return all_.size() > made.size();
  }

 private:
  const Vector<double> &lines_;
  Vector<double> all_;
};

Vector<double> shares_of(const Vector<GridLine> &lines, double GridLine::*t) {
  Vector<double> made;
  for (const GridLine &line : lines) made.push_back(line.*t);
  return made;
}

struct TwoCurves {
  Curve now, before;
};

// Returns the curves of a side in both states, in the side's direction.
TwoCurves curves_of(const TwoStates &states, std::size_t patch, Side Patch::*side) {
  return {along(states.now, states.now.patches[patch].*side), along(states.before, states.before.patches[patch].*side)};
}

// Bounds the largest curvature of a curve. The bound is infinite if the curve may reverse its direction at a point.
double largest_curvature(const Curve &curve) {
  double largest = 0;
  for (const Bezier &span : curve.spans()) largest = larger(largest, largest_curvature(span));
  return largest;
}

double size_of(double x) { return std::abs(x); }
double size_of(Vec3 x) { return length(x); }

// Bounds the absolute values of a function and of its first two derivatives on [0, 1].
struct Sizes {
  double size = 0, slope = 0, bend = 0;
};

// Returns the sizes of the polynomial through values at n_material nodes.
template <class T>
Sizes sizes_of(const std::array<double, n_material> &nodes, std::array<T, n_material> factors) {
  constexpr std::size_t n = n_material - 1;
  // The values are converted to Newton's form, then to powers of x, and then to the control points of a Bézier curve. The control
  // points bound the polynomial.
  for (std::size_t order = 1; order <= n; ++order)
    for (std::size_t i = n; i >= order; --i)
      factors[i] = (1 / (nodes[i] - nodes[i - order])) * (factors[i] - factors[i - 1]);
  std::array<T, n_material> power{}, control{};
  power[0] = factors[n];
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = n; k > 0; --k) power[k] = power[k - 1] - nodes[i] * power[k];
    power[0] = factors[i] - nodes[i] * power[0];
  }
  Sizes made;
  for (std::size_t j = 0; j <= n; ++j) {
    double share = 1;  // binomial(j, k) / binomial(n, k)
    for (std::size_t k = 0; k <= j; ++k) {
      control[j] = control[j] + share * power[k];
      share *= static_cast<double>(j - k) / static_cast<double>(n - k);
    }
    made.size = std::max(made.size, size_of(control[j]));
    if (j > 0) made.slope = std::max(made.slope, static_cast<double>(n) * size_of(control[j] - control[j - 1]));
    if (j > 1)
      made.bend = std::max(made.bend, static_cast<double>(n * (n - 1)) *
                                          size_of((control[j] - control[j - 1]) - (control[j - 1] - control[j - 2])));
  }
  return made;
}

// Returns the sizes of a polynomial of this degree that is given as a function.
template <class Rest>
Sizes sizes_of(const Rest &rest) {
  std::array<double, n_material> nodes{};
  std::array<Vec3, n_material> values{};
  for (std::size_t k = 0; k < n_material; ++k) {
    nodes[k] = static_cast<double>(k) / static_cast<double>(n_material - 1);
    values[k] = rest(nodes[k]);
  }
  return sizes_of(nodes, values);
}

// Returns the sizes of a side's slide, which is the share in the earlier state minus the share now.
Sizes sizes_of_slide(const SideMaterial &material) {
  const std::array<double, n_material> &nodes = material.nodes();
  const Vector<double> before = material.shares_before(Vector<double>(nodes.begin(), nodes.end()));
  std::array<double, n_material> slide{};
  for (std::size_t k = 0; k < n_material; ++k) slide[k] = before[k] - nodes[k];
  return sizes_of(nodes, slide);
}

// Bounds the distance of a function from a linear function on a range. `of` bounds the function and its derivatives.
double off_line(double width, const Sizes &of) {
  return std::min({0.5 * width * of.slope, off_line(width, of.bend), 2 * of.size});
}

// The displacement that SideMaterial adds between points at equal shares. This displacement is C(u) - C(u + slide(u)) + rest(u).
// C is the side's curve in the earlier state.
class AddedByMaterial {
 public:
  // `third` bounds the third derivative of C with respect to the share. `third` may be infinite.
  AddedByMaterial(const SideMaterial &material, const Curve &before, double third) {
    if (!material.is_warped()) return;
    const Sizes slide = sizes_of_slide(material);
    const double length = before.length(), shift = length * slide.size;
    const double second = length > 0 ? length * length * largest_curvature(before) : 0;
    const double turn = length > 0 ? std::min(2 * length, second * slide.size) : 0;
    bounds_ = {shift, turn + length * slide.slope,
               third * slide.size + second * slide.slope * (2 + slide.slope) + length * slide.bend};
    rest_ = sizes_of([&](double share) { return material.rest(share); });
    // Between a joint and its place after the slide, the two second derivatives belong to different spans.
    of_joints_ = static_cast<double>(before.spans().size() - 1) * 0.25 * 2 * second * slide.size;
  }

  double slope() const { return bounds_.slope + rest_.slope; }
  // Bounds how far the displacement deviates from linear on a range.
  double off_linear(double width) const {
    const double smooth = larger(off_line(width, bounds_.bend) + width * of_joints_, 0);
    const double coarse = std::min(0.5 * width * bounds_.slope, 2 * bounds_.size);
    return (smooth <= coarse ? smooth : coarse) + off_line(width, rest_);
  }

 private:
  Sizes bounds_, rest_;
  double of_joints_ = 0;
};

// For every pair of neighbouring lines, bounds how far a side's displacement deviates from linear. The bound includes the
// difference between a line's share on the side and the line's `middle`.
Vector<double> off_linear(const TwoCurves &curves, const SideMaterial &material, const Vector<GridLine> &lines,
                          double GridLine::*t) {
  const Vector<double> at_lines = shares_of(lines, t);
  Shares shares(at_lines, {&curves.now, &curves.before});
  for (int round = 0; round < most_rounds; ++round) {
    const SideInBoth side(curves.now, curves.before, shares.all());
    if (!shares.halve([&](std::size_t i) { return side.between(i).is_tight; })) break;
  }
  const SideInBoth side(curves.now, curves.before, shares.all());
  const double both_lengths = curves.now.length() + curves.before.length();
  double third = 0;
  for (std::size_t i = 0; i + 1 < shares.all().size(); ++i) {
    const AlongCurve on = side.between(i);
    third = larger(third, (on.length * on.second).size);
  }
  const AddedByMaterial added(material, curves.before, third);
  Vector<double> made;
  for (std::size_t k = 0; k + 1 < lines.size(); ++k) {
    const std::size_t from = shares.line(k), to = shares.line(k + 1);
    const double start = shares.all()[from], width = shares.all()[to] - start;
    double error = 0, largest = 0;
    for (std::size_t i = from; i < to; ++i) {
      const AlongCurve on = side.between(i);
      const double second = side.is_compared(i) ? on.second_of_point().change : on.size_now + on.size_before;
      // The error of linear interpolation is the integral of Green's function times the second derivative. Green's function is at
      // most x (width - x) / width, and its integral is at most width squared / 8.
      const double x0 = shares.all()[i] - start, x1 = shares.all()[i + 1] - start, x = std::clamp(0.5 * width, x0, x1);
      error += (x1 - x0) * x * (width - x) / width * second;
      largest = larger(largest, second);
    }
    error = std::min(error, off_line(width, largest));
    // This bound always holds, because a point of a curve is at most the curve's length away from the chord.
    if (!(error <= both_lengths * width)) error = both_lengths * width;
    error += added.off_linear(width);
    const double slope = both_lengths + added.slope();
    const auto shift = [&](const GridLine &line) { return slope * std::abs(line.*t - line.middle); };
    made.push_back(error + larger(shift(lines[k]), shift(lines[k + 1])));
  }
  return made;
}

// The bounds of the offset O of a patch of arcs, and of O's derivatives with respect to u, on a range. The bounds leave out O's
// factor, the patch's bulge.
struct ArcRangeInBoth {
  Both first, second;
  double largest;  // bounds |O| in both states
  double m_least;  // the least |W x T|; 0 or less if W x T may vanish
  bool is_tight;
};

ArcRangeInBoth offset_on(const SideInBoth &base, const SideInBoth &edge, std::size_t i) {
  const AlongCurve b = base.between(i), e = edge.between(i);
  const double width = base.width(i);
  const Both w2 = e.second_of_point() + b.second_of_point();
  const auto value = [&](std::size_t k, bool now) {
    return now ? edge.now(k) - base.now(k) : edge.before(k) - base.before(k);
  };
  const auto slope = [&](std::size_t k, bool now) {
    return now ? edge.curve_now().length() * edge.tangent_now(k) - base.curve_now().length() * base.tangent_now(k)
               : edge.curve_before().length() * edge.tangent_before(k) -
                     base.curve_before().length() * base.tangent_before(k);
  };
  const Vec3 now[2] = {value(i, true), value(i + 1, true)}, before[2] = {value(i, false), value(i + 1, false)};
  const double bend = off_line(width, w2.size);
  const Both w0{larger(larger_of(now[0], now[1]), larger_of(before[0], before[1])) + bend,
                larger(distance(now[0], before[0]), distance(now[1], before[1])) + off_line(width, w2.change)};
  // Also bounds |W| from the ends of the range, because no point moves along a curve by more than the curve's length.
  const double w_far =
      larger(larger_of(now[0], now[1]), larger_of(before[0], before[1])) + width * (edge.longer() + base.longer());
  const double w_largest = w0.size <= w_far ? w0.size : w_far;
  const double w_least = std::min(least_on_segment(now[0], now[1]), least_on_segment(before[0], before[1])) - bend;
  // W' is its value at the start of the range plus its change along the range. At the start of the range, both states have a
  // direction.
  const Both w1{larger_of(slope(i, true), slope(i, false)) + width * w2.size,
                distance(slope(i, true), slope(i, false)) + width * w2.change};
  const Both m1 = w1 * b.value + w0 * b.first, m2 = w2 * b.value + 2 * w1 * b.first + w0 * b.second;
  const auto normal = [&](std::size_t k, bool at_now) {
    return cross(value(k, at_now), at_now ? base.tangent_now(k) : base.tangent_before(k));
  };
  const Vec3 start_now = normal(i, true), start_before = normal(i, false);
  const Vec3 end_now = normal(i + 1, true), end_before = normal(i + 1, false);
  const double m_bend = off_line(width, m2.size);
  const double m_least =
      std::min(least_on_segment(start_now, end_now), least_on_segment(start_before, end_before)) - m_bend;
  const double m_size = larger(larger_of(start_now, end_now), larger_of(start_before, end_before)) + m_bend;
  const double m_change =
      larger(distance(start_now, start_before), distance(end_now, end_before)) + off_line(width, m2.change);
  if (!(m_least > 0 && w_least > 0)) {
    const Both unknown{infinity, infinity};
    return {unknown, unknown, w_largest, 0, false};
  }
  // Computes |W| and its derivatives, then the unit vector along M and its derivatives.
  const Both to_w{1, w0.change / w_least}, across_w{1, to_w.change};
  const Both size0{w0.size, w0.change}, size1 = to_w * w1;
  const Both size2 = to_w * w2 + across_w * w1 * across_w * w1 * inverse(w_least, w0.change);
  const Both unit{1, m_change / m_least}, across{1, unit.change}, inverse_m = inverse(m_least, m_change);
  const Both unit1 = inverse_m * across * m1;
  const Both inverse_m1 = inverse_m * inverse_m * unit * m1;
  const Both across1{unit1.size, 2 * (unit1.change + unit1.size * unit.change)};
  const Both unit2 = inverse_m1 * across * m1 + inverse_m * across1 * m1 + inverse_m * across * m2;
  return {size1 * unit + size0 * unit1, size2 * unit + 2 * size1 * unit1 + size0 * unit2, w_largest, m_least,
          b.is_tight && e.is_tight && w_least >= tight_share * w0.size && m_least >= tight_share * m_size};
}

// Bounds how much O without its factor changes if points of the base and the edge slide as SideMaterial says.
class SlidOffset {
 public:
  SlidOffset(const SideMaterial &on_base, const SideMaterial &on_edge, const Curve &base, const Curve &edge) {
    if (!on_base.is_warped() || !on_edge.is_warped()) return;
    const double shift = base.length() * sizes_of_slide(on_base).size;
    width_ = shift + edge.length() * sizes_of_slide(on_edge).size;
    turn_ = base.length() > 0 ? std::min(2.0, shift * largest_curvature(base)) : 0;
  }

  double change(const ArcRangeInBoth &on) const {
    if (width_ == 0 && turn_ == 0) return 0;
    const double largest = on.largest + width_;
    const double of_direction = on.m_least > 0 ? std::min(2.0, 2 * (width_ + largest * turn_) / on.m_least) : 2;
    return width_ + largest * of_direction;
  }

 private:
  double width_ = 0, turn_ = 0;  // bound the changes of W and of T
};

// For every pair of neighbouring lines, bounds how far O's displacement deviates from linear.
Vector<double> offset_off_linear(const TwoStates &states, std::size_t patch, const TwoCurves &base,
                                 const TwoCurves &edge, const Vector<GridLine> &lines) {
  const MovedPatch moved{states.now, states.before, patch};
  const SideMaterial material_of_base(moved, &Patch::v0), material_of_edge(moved, &Patch::v1);
  const SlidOffset slid(material_of_base, material_of_edge, base.before, edge.before);
  const Through<Vec3> rest_of = rest_of_offsets(moved, material_of_base, material_of_edge);
  const Sizes rest = sizes_of([&](double share) { return rest_of.at(share); });
  const double factor = states.now.patches[patch].bulge, factor_before = states.before.patches[patch].bulge;
  const Both of_factor{larger(std::abs(factor), std::abs(factor_before)), std::abs(factor - factor_before)};
  const Vector<double> at_lines = shares_of(lines, &GridLine::middle);
  Shares shares(at_lines, {&base.now, &base.before, &edge.now, &edge.before});
  for (int round = 0; round < most_rounds; ++round) {
    const SideInBoth on_base(base.now, base.before, shares.all()), on_edge(edge.now, edge.before, shares.all());
    if (!shares.halve([&](std::size_t i) { return offset_on(on_base, on_edge, i).is_tight; })) break;
  }
  const SideInBoth on_base(base.now, base.before, shares.all()), on_edge(edge.now, edge.before, shares.all());
  const auto is_joint = [&](std::size_t i) { return on_base.is_joint(i) || on_edge.is_joint(i); };
  Vector<double> made;
  Vector<Slope> slopes;
  for (std::size_t k = 0; k + 1 < lines.size(); ++k) {
    const std::size_t from = shares.line(k), to = shares.line(k + 1);
    const double width = shares.all()[to] - shares.all()[from];
    double largest = 0, second = 0, slides = 0;
    bool is_smooth = true;
    slopes.clear();
    for (std::size_t i = from; i < to; ++i) {
      const ArcRangeInBoth on = offset_on(on_base, on_edge, i);
      largest = larger(largest, on.largest);
      slides = larger(slides, slid.change(on));
      const bool is_compared = on_base.is_compared(i) && on_edge.is_compared(i);
      is_smooth = is_smooth && is_compared && !(i > from && is_joint(i));
      second = larger(second, (of_factor * on.second).change);
      slopes.push_back(
          {on_base.width(i), is_compared ? (of_factor * on.first).change : 2 * of_factor.size * on.first.size});
    }
    // O' jumps at a joint, so the bound for a range with a joint uses the first derivative. Near a curve's end, the bounds on the
    // short span next to a joint are far above the true derivatives.
    double error = is_smooth ? off_line(width, second) : off_line(slopes);
    const double at_most = 4 * of_factor.size * largest;  // bounds |O| and its linear interpolation, in both states
    if (!(error <= at_most)) error = at_most;
    error += 2 * of_factor.size * slides + off_line(width, rest);
    made.push_back(error);
  }
  return made;
}

// Returns how far the offset O of a patch of arcs moves at these u.
Vector<Vec3> offset_moves(const TwoStates &states, std::size_t patch, const TwoCurves &base, const TwoCurves &edge,
                          const Vector<double> &u) {
  const MovedPatch moved{states.now, states.before, patch};
  const SideMaterial on_base(moved, &Patch::v0), on_edge(moved, &Patch::v1);
  const bool is_warped = on_base.is_warped() && on_edge.is_warped();
  const Vector<double> u_base = is_warped ? on_base.shares_before(u) : u,
                       u_edge = is_warped ? on_edge.shares_before(u) : u;
  Vector<Vec3> made = arc_offsets(states.now, states.now.patches[patch], CurvePoints(base.now, false, u),
                                  CurvePoints(edge.now, false, u));
  const Vector<Vec3> before =
      arc_offsets(states.before, states.before.patches[patch], CurvePoints(base.before, false, u_base),
                  CurvePoints(edge.before, false, u_edge));
  const Through<Vec3> rest = rest_of_offsets(moved, on_base, on_edge);
  for (std::size_t i = 0; i < made.size(); ++i) made[i] = made[i] - before[i] + rest.at(u[i]);
  return made;
}

// A warp's map adds a part to the displacement inside a warped Coons patch. Bounds how far this part deviates from linear, on a
// range of u or of v. The part is made of polynomials. On [0, 1], the sizes of their second derivatives add up to at most 81. The
// sizes of their values add up to at most 1.3.
double off_linear(const RestInside &rest, double width) {
  double size = 0;
  for (const double u : {1. / 3, 2. / 3})
    for (const double v : {1. / 3, 2. / 3}) size = std::max(size, length(rest.at(u, v)));
  return 0.125 * width * width * 106 * size;
}

// Bounds of the errors of a patch's displacements and points, at equal (u, v) and before an image is placed.
struct PatchErrors {
  double displacement = 0, point = 0;
};

PatchErrors errors_of(const TwoStates &states, std::size_t patch, const LevelledGrid &levelled) {
  const QuadGrid &grid = levelled.grid;
  const MovedPatch moved{states.now, states.before, patch};
  const PatchDisplacement motion(moved, levelled);
  const bool has_arcs = states.now.patches[patch].bulge != 0 || states.before.patches[patch].bulge != 0;
  const TwoCurves v0 = curves_of(states, patch, &Patch::v0), v1 = curves_of(states, patch, &Patch::v1);
  const Vector<double> at_v0 = off_linear(v0, {moved, &Patch::v0}, grid.lines.u, &GridLine::t0),
                       at_v1 = off_linear(v1, {moved, &Patch::v1}, grid.lines.u, &GridLine::t1);
  Vector<double> at_u0(grid.v.size() - 1, 0), at_u1 = at_u0, offset(grid.u.size() - 1, 0), rows = offset;
  if (has_arcs) {
    offset = offset_off_linear(states, patch, v0, v1, grid.lines.u);
    const Vector<Vec3> moves = offset_moves(states, patch, v0, v1, shares_of(grid.lines.u, &GridLine::middle));
    for (std::size_t i = 0; i + 1 < grid.u.size(); ++i) rows[i] = larger_of(moves[i], moves[i + 1]);
  } else {
    at_u0 = off_linear(curves_of(states, patch, &Patch::u0), {moved, &Patch::u0}, grid.lines.v, &GridLine::t0);
    at_u1 = off_linear(curves_of(states, patch, &Patch::u1), {moved, &Patch::u1}, grid.lines.v, &GridLine::t1);
  }
  const RestInside rest(moved, PatchMaterial(moved));
  PatchErrors made;
  auto next_level = levelled.levels.begin();
  for_each_quad(grid, [&](std::size_t i, std::size_t j) {
    const int level = *next_level++, n = 1 << level;
    const double row = grid.v[j + 1] - grid.v[j], width = grid.u[i + 1] - grid.u[i];
    // The arcs add 2 v (1-v) times the offset. Between two vertices, this term deviates from linear by at most row^2 / 2 times
    // the offset.
    double error = larger_mix(at_v0[i], at_v1[i], grid.v[j], grid.v[j + 1]) +
                   larger_mix(at_u0[j], at_u1[j], grid.u[i], grid.u[i + 1]) +
                   largest_arc_weight(grid.v[j], grid.v[j + 1]) * offset[i] + 0.5 * row * row * rows[i] +
                   off_linear(rest, width) + off_linear(rest, row);
    double twist = 0;
    for (int k = 0; k < n * n; ++k) {
      const int column = k % n, at_row = k / n;
      const auto at = [&](int du, int dv) { return motion.in_quad(i, j, level, column + du, at_row + dv); };
      twist = larger(twist, quad_flatness({at(0, 0), at(1, 0), at(1, 1), at(0, 1)}));
    }
    // If a neighbour has fewer subdivisions, the vertices on the common side are interpolated linearly between the neighbour's
    // vertices.
    const auto is_less = [&](bool is_inside, std::size_t beside) {
      return is_inside && levelled.levels[beside] < level;
    };
    const std::size_t n_u = grid.u.size() - 1, n_v = grid.v.size() - 1, here = j * n_u + i;
    const bool has_coarser = is_less(i > 0, here - 1) || is_less(i + 1 < n_u, here + 1) || is_less(j > 0, here - n_u) ||
                             is_less(j + 1 < n_v, here + n_u);
    made.displacement = larger(made.displacement, (has_coarser ? 2 : 1) * error + twist);
    made.point = larger(made.point, grid.error(i, j) + std::ldexp(quad_flatness(quad_of(grid, i, j)), -2 * level));
  });
  return made;
}

// Bounds the error of an image's velocity from the errors of the displacement and of the point.
double velocity_error(const ImageVelocity &image, const TwoStates &states, const PatchErrors &errors) {
  const auto of_rest = [&](Vec3 p) { return image.velocity(p, {0, 0, 0}); };
  const Vec3 offset = of_rest({0, 0, 0});
  double square = 0;  // bounds the Frobenius norm of the map that takes a point at rest to its velocity
  for (const Vec3 &unit : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Vec3 column = of_rest(unit) - offset;
    square += dot(column, column);
  }
  return states.placement_before.scale * errors.displacement / std::abs(states.seconds) +
         std::sqrt(square) * (errors.point + states.now.deviation);
}

}  // namespace
}  // namespace riis

double velocity_error_bound(const riis_surface *surface, const riis_valve *valve, const riis_valve *before,
                            double seconds, const riis_surface_options *options_before) {
  const riis::Surface &content = riis::content_of(surface);
  const riis::Placement &placement = content.source()->placement;
  const riis::TwoStates states{*content.patches(), valve->valve.make_patches_before(before->valve, nullptr), placement,
                               options_before ? riis::placement_of(*options_before) : placement, seconds};
  const riis::EarlierState motion{states.before, states.placement_before, states.seconds};
  const auto &grids = content.triangles().grids;
  double bound = 0;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const riis::PatchErrors errors = riis::errors_of(states, i, grids[i]);
    const riis::Patch &patch = states.now.patches[i];
    for (std::size_t k = 0; k < patch.images.size(); ++k) {
      const riis::ImageVelocity image(patch.images[k], states.before.patches[i].images[k], placement, motion);
      bound = riis::larger(bound, riis::velocity_error(image, states, errors));
    }
  }
  return bound * (1 + 1e-9);
}
