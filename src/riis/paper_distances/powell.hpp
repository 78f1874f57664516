// SPDX-License-Identifier: Apache-2.0
// Minimises a function of (u,v) in [0,1]^2 by Powell's method: M. J. D. Powell, "An efficient method for finding the minimum of a
// function of several variables without calculating derivatives", The Computer Journal 7 (1964) 155-162. The direction that is
// dropped follows from the modified rule of Powell's paper. Lines are searched by Brent's method: R. P. Brent, "Algorithms for
// Minimization without Derivatives" (1973), chapter 5.
// The result is a local minimum whose value is at most the value at the start.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace riis {

struct Parameters {
  double u, v;
};
inline Parameters operator-(Parameters a, Parameters b) { return {a.u - b.u, a.v - b.v}; }

struct LocalMinimum {
  Parameters at;
  double value;
};

// The steps t for which from + t * along lies in [0,1]^2. For any `from` in the square, these steps form an interval that
// contains 0.
struct Segment {
  double low, high;
};
inline Segment segment_within_square(Parameters from, Parameters along) {
  Segment all{-HUGE_VAL, HUGE_VAL};
  const auto cut = [&](double x, double slope) {
    if (slope == 0) return;
    const double to_0 = -x / slope, to_1 = (1 - x) / slope;
    all = {std::max(all.low, std::min(to_0, to_1)), std::min(all.high, std::max(to_0, to_1))};
  };
  cut(from.u, along.u);
  cut(from.v, along.v);
  return {std::min(all.low, 0.0), std::max(all.high, 0.0)};
}
inline Parameters step(Parameters from, double t, Parameters along) {
  return {std::clamp(from.u + t * along.u, 0.0, 1.0), std::clamp(from.v + t * along.v, 0.0, 1.0)};
}

// Finds a minimum of f(t) on [low, high] by the function localmin of Brent's book. The error of t is about three times the
// tolerance. If f has several minima, the result is the least of all computed values. The next point is the minimum of a parabola
// through the last three points or, if the parabola is of no use, a golden section.
template <class Function>
std::array<double, 2> minimum_on_segment(const Function &f, double low, double high, double tolerance) {
  constexpr double golden = 0.3819660112501051;  // (3 - sqrt 5) / 2
  double x = low + golden * (high - low), w = x, v = x, fx = f(x), fw = fx, fv = fx;
  double last = 0, before_last = 0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    if (std::abs(x - middle) <= 2 * tolerance - 0.5 * (high - low)) break;
    bool is_golden = true;
    double d = 0;
    if (std::abs(before_last) > tolerance) {
      const double r = (x - w) * (fx - fv);
      double q = (x - v) * (fx - fw), p = (x - v) * q - (x - w) * r;
      q = 2 * (q - r);
      if (q > 0) p = -p;
      q = std::abs(q);
      if (std::abs(p) < std::abs(0.5 * q * before_last) && p > q * (low - x) && p < q * (high - x)) {
        is_golden = false;
        before_last = last;
        d = p / q;
        const double u = x + d;
        if (u - low < 2 * tolerance || high - u < 2 * tolerance) d = x < middle ? tolerance : -tolerance;
      }
    }
    if (is_golden) {
      before_last = x < middle ? high - x : low - x;
      d = golden * before_last;
    }
    last = d;
    const double u = std::abs(d) >= tolerance ? x + d : x + (d > 0 ? tolerance : -tolerance), fu = f(u);
    if (fu <= fx) {
      (u < x ? high : low) = x;
      v = w, fv = fw, w = x, fw = fx, x = u, fx = fu;
    } else {
      (u < x ? low : high) = u;
      if (fu <= fw || w == x)
        v = w, fv = fw, w = u, fw = fu;
      else if (fu <= fv || v == x || v == w)
        v = u, fv = fu;
    }
  }
  return {x, fx};
}

// Minimises f >= 0 over [0,1]^2 from a start in the square. Each line is searched along its whole segment in the square. Brent's
// method only approaches the ends of the segment, but closest points are often there, at the rim. The search therefore also
// evaluates both ends. step_of(d) returns the allowed error of a line search along d, in units of d.
template <class Function, class StepOf>
LocalMinimum minimize_by_powell(const Function &f, Parameters start, double enough, const StepOf &step_of) {
  LocalMinimum best{start, f(start)};
  const auto search_along = [&](Parameters along) {
    const Parameters from = best.at;
    const auto [low, high] = segment_within_square(from, along);
    const auto offer = [&](double t, double value) {
      if (value < best.value) best = {step(from, t, along), value};
    };
    const auto at = [&](double t) { return f(step(from, t, along)); };
    const double tolerance = step_of(along);
    if (!(high - low > tolerance)) return;
    const auto [t, value] = minimum_on_segment(at, low, high, tolerance);
    offer(t, value);
    offer(low, at(low));
    offer(high, at(high));
  };

  std::array<Parameters, 2> along{{{1, 0}, {0, 1}}};
  constexpr int max_iterations = 100;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const LocalMinimum before = best;
    double largest_gain = 0;
    std::size_t of_largest = 0;
    for (std::size_t k = 0; k < along.size(); ++k) {
      const double value = best.value;
      search_along(along[k]);
      if (value - best.value > largest_gain) largest_gain = value - best.value, of_largest = k;
    }
    if (std::sqrt(before.value) - std::sqrt(best.value) <= enough) break;
    // Extrapolates: repeats the displacement of this iteration, but stops at the edge of the square.
    const Parameters whole = best.at - before.at;
    const double beyond = f(step(best.at, std::min(1.0, segment_within_square(best.at, whole).high), whole));
    if (!(beyond < before.value)) continue;
    const double bend = before.value - 2 * best.value + beyond, rest = before.value - best.value - largest_gain;
    const double gain = before.value - beyond;
    if (!(2 * bend * rest * rest < largest_gain * gain * gain)) continue;
    search_along(whole);
    along[of_largest] = along.back();
    along.back() = whole;
  }
  return best;
}

}  // namespace riis
