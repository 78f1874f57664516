// SPDX-License-Identifier: Apache-2.0
#include "valve/landmark_cuts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/array_view.hpp"
#include "geometry/bezier.hpp"

namespace riis {
namespace {

// A landmark lies on a curve if its distance is at most `share_on_curve` of the curve's length.
constexpr double share_on_curve = 0.01;
// A landmark makes no cut nearer than `least_part`, in the span's parameter, to an end of the span or to another cut. At ends and
// cuts, the warped curve has the right point and direction, so it is also right beside them.
constexpr double least_part = 1.0 / 256;
// The search for the nearest point of a span continues beside the best of `n_search_steps` evenly spaced points.
constexpr int n_search_steps = 16;

double polygon_length(const Bezier &span) {
  double sum = 0;
  for (int i = 0; i < span.degree; ++i) sum += distance(view(span.control)[i], view(span.control)[i + 1]);
  return sum;
}

// Returns false only if the box around the control points, and thus the span, is farther than `reach` from the point.
bool is_near_box(const Bezier &span, Vec3 p, double reach) {
  for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    double least = span.first().*axis, most = least;
    for (int i = 1; i <= span.degree; ++i) {
      least = std::min(least, view(span.control)[i].*axis), most = std::max(most, view(span.control)[i].*axis);
    }
    if (p.*axis < least - reach || p.*axis > most + reach) return false;
  }
  return true;
}

// Returns the parameter of the span's point that is nearest to p, to rounding.
double nearest_parameter(const Bezier &span, Vec3 p) {
  double t = 0, least = distance(p, span.first());
  for (int i = 1; i <= n_search_steps; ++i) {
    const double at = static_cast<double>(i) / n_search_steps, apart = distance(p, evaluate(span, at));
    if (apart < least) least = apart, t = at;
  }
  constexpr double step = 1.0 / n_search_steps;
  double low = std::max(0.0, t - step), high = std::min(1.0, t + step);
  // If the derivative of half the squared distance keeps its sign between the ends, the nearest point is an end.
  for (int i = 0; i < 60 && high - low > 1e-15; ++i) {
    const auto d = derivatives(span, t);
    const Vec3 apart = evaluate(span, t) - p;
    const double slope = dot(apart, d[0]), curvature = dot(d[0], d[0]) + dot(apart, d[1]);
    (slope > 0 ? high : low) = t;
    const double newton = curvature > 0 ? t - slope / curvature : low;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (std::abs(next - t) <= 1e-15) return next;
    t = next;
  }
  return t;
}

bool is_before(const PointOnSpan &a, const PointOnSpan &b) { return a.span != b.span ? a.span < b.span : a.t < b.t; }

// Adds a cut to an ascending list if no other cut is too near.
void add_cut(Vector<PointOnSpan> &cuts, const PointOnSpan &cut) {
  const auto at = std::lower_bound(cuts.begin(), cuts.end(), cut, is_before);
  const auto is_too_near = [&](const PointOnSpan &other) {
    return other.span == cut.span && std::abs(other.t - cut.t) < least_part;
  };
  if (at != cuts.end() && is_too_near(*at)) return;
  if (at != cuts.begin() && is_too_near(*(at - 1))) return;
  cuts.insert(at, cut);
}

// Returns the place at which a landmark cuts the curve, or nothing if the landmark makes no cut.
std::optional<PointOnSpan> cut_by(const Vector<Bezier> &spans, Vec3 landmark, double reach) {
  PointOnSpan nearest{0, 0};
  double least = reach;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    if (spans[i].is_point() || !is_near_box(spans[i], landmark, reach)) continue;
    const double t = nearest_parameter(spans[i], landmark), apart = distance(landmark, evaluate(spans[i], t));
    if (apart <= least) least = apart, nearest = {i, t};
  }
  if (nearest.t < least_part || nearest.t > 1 - least_part) return std::nullopt;
  return nearest;
}

// The number of sides of a patch that may be cut. The sides u0 and u1 of a patch of arcs are not cut, because a warp replaces
// them by new arcs between v0 and v1.
std::array<const Side *, 4> sides_of(const Patch &patch) { return {&patch.v0, &patch.v1, &patch.u0, &patch.u1}; }
std::size_t n_sides_to_cut(const PatchSet &set) { return set.rates.empty() ? 2 : 4; }

}  // namespace

void LandmarkCuts::add(const PatchSet &state, const WarpMap &map) {
  Unfolding unfolding(state);
  Vector<Vector<PointOnSpan>> of_copies;
  for (const CurveCopy &copy : unfolding.copies()) {
    of_copies.emplace_back();
    double size = 0;
    for (const Bezier &span : copy.spans) size += polygon_length(span);
    for (std::size_t i = 0; i < map.n_sources; ++i)
      if (const auto cut = cut_by(copy.spans, map.source(i), share_on_curve * size)) add_cut(of_copies.back(), *cut);
  }
  on_sides_.resize(4 * unfolding.patches().size());
  for (std::size_t i = 0; i < unfolding.patches().size(); ++i)
    for (std::size_t k = 0; k < n_sides_to_cut(state); ++k)
      for (const PointOnSpan &cut : of_copies[sides_of(unfolding.patches()[i])[k]->curve])
        add_cut(on_sides_[4 * i + k], cut);
}

Vector<Vector<PointOnSpan>> cuts_by_copy(Unfolding &unfolding, const LandmarkCuts &cuts) {
  Vector<Vector<PointOnSpan>> made(unfolding.copies().size());
  for (std::size_t i = 0; i < unfolding.patches().size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t copy = sides_of(unfolding.patches()[i])[k]->curve;
      for (const PointOnSpan &cut : cuts.on_side(i, k))
        if (cut.span < unfolding.copies()[copy].spans.size()) add_cut(made[copy], cut);
    }
  return made;
}

Vector<Bezier> cut_at(const Vector<Bezier> &spans, const Vector<PointOnSpan> &cuts) {
  Vector<Bezier> made;
  auto cut = cuts.begin();
  for (std::size_t i = 0; i < spans.size(); ++i) {
    Bezier rest = spans[i];
    for (double from = 0; cut != cuts.end() && cut->span == i; from = (cut++)->t) {
      const auto [before, behind] = split(rest, (cut->t - from) / (1 - from));
      made.push_back(before);
      rest = behind;
    }
    made.push_back(rest);
  }
  return made;
}

}  // namespace riis
