// SPDX-License-Identifier: Apache-2.0
#include "valve/warp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "geometry/coons.hpp"
#include "geometry/curve.hpp"
#include "valve/landmark_cuts.hpp"
#include "valve/unfolding.hpp"

namespace riis {
namespace {

// The parameter of a curve is divided into `n_curve_steps` equal steps. The points at the ends of these steps are warped.
constexpr int n_curve_steps = 6;
// The warp stretches a tangent. The length of the stretched tangent may also be multiplied by a factor from `least_factor` to
// `most_factor`.
constexpr double least_factor = 0.2, most_factor = 5, most_of_missing = 0.5;
// A patch is searched for folds on a grid of `n_fold_cells` by `n_fold_cells` cells.
constexpr std::size_t n_fold_cells = 3;
// A cell is a sliver if the sine of the angle between its diagonals is below `sliver_sine`. A sliver is so narrow that it has no
// clear normal. Half-open coapting leaflets have slivers beside the attachment. The chords of a curve in a sliver do not show the
// direction of the surface. Slivers are therefore not checked. In 20,000 states of valves with rough warps, cells with a sine up
// to 0.067 turned over although no triangle did. Where triangles turned over and no wider cell did, the triangles had at most 0.6
// mm^2. One cell of the default valve has the sine 0.041 at the opening 0.9.
constexpr double sliver_sine = 0.07;

Bezier raised_to_cubic(const Bezier &span) {
  if (span.degree == 3) return span;
  const auto &q = span.control;
  return Bezier::cubic(q[0], (1.0 / 3) * (q[0] + 2 * q[1]), (1.0 / 3) * (2 * q[1] + q[2]), q[2]);
}

const Vector<double> &material_shares() {
  static const Vector<double> &shares = *new Vector<double>([] {
    Vector<double> made;
    for (std::size_t k = 0; k < n_material; ++k) made.push_back(material_share(k));
    return made;
  }());
  return shares;
}

struct EndTangent {
  Vec3 warped;    // the direction, as long as the warp makes it
  double factor;  // 1 if the curve itself has a tangent there, else 0
};

// Returns the direction of a curve at the first of these control points. The direction leads from the curve's first control point
// to the next control point that differs from it.
EndTangent end_tangent(const std::array<Vec3, 4> &control, const MapAt &at) {
  const double size =
      distance(control[0], control[1]) + distance(control[1], control[2]) + distance(control[2], control[3]);
  for (int i = 1; i < 4; ++i) {
    const Vec3 along = view(control)[i] - control[0];
    if (length(along) > 1e-9 * size) return {at.along(along), i == 1 ? 1.0 : 0.0};
  }
  return {{0, 0, 0}, 0};
}

double within_limits(double factor, double own) {
  return own == 0 ? std::clamp(factor, 0.0, most_of_missing) : std::clamp(factor, least_factor, most_factor);
}

// The mapped points of a span at even parameters.
using MappedSpan = std::array<Vec3, n_curve_steps + 1>;

// Returns the cubic with the warped ends and the warped directions there. The lengths of its end tangents fit the warped points
// best. `first` and `last` give the map at the ends. Also writes the warped points.
Bezier warped_span(const Bezier &given, const MapAt &first, const MapAt &last, const BlendedWarp &warp,
                   MappedSpan &mapped) {
  mapped.fill(first.value);
  if (given.is_point()) return Bezier::point(first.value);
  mapped.back() = last.value;
  const Bezier cubic = raised_to_cubic(given);
  const EndTangent a = end_tangent(cubic.control, first), b = end_tangent(cubic.reversed().control, last);
  double aa = 0, ab = 0, bb = 0, ar = 0, br = 0;
  for (int k = 1; k < n_curve_steps; ++k) {
    const double t = static_cast<double>(k) / n_curve_steps, s = 1 - t;
    const double b0 = s * s * s, b1 = 3 * t * s * s, b2 = 3 * t * t * s, b3 = t * t * t;
    view(mapped)[k] = warp.value(evaluate(cubic, t));
    const Vec3 rest = view(mapped)[k] - ((b0 + b1) * first.value + (b2 + b3) * last.value);
    const Vec3 by_a = b1 * a.warped, by_b = b2 * b.warped;
    aa += dot(by_a, by_a), ab += dot(by_a, by_b), bb += dot(by_b, by_b);
    ar += dot(by_a, rest), br += dot(by_b, rest);
  }
  double of_a = a.factor, of_b = b.factor;
  const double determinant = aa * bb - ab * ab;
  if (determinant > 1e-12 * aa * bb) {
    of_a = within_limits((ar * bb - br * ab) / determinant, a.factor);
    of_b = within_limits((br - of_a * ab) / bb, b.factor);
  }
  return Bezier::cubic(first.value, first.value + of_a * a.warped, last.value + of_b * b.warped, last.value);
}

// Returns the cubic through the rates of the warped points at 0, 1/3, 2/3 and 1. The map's derivative is known at the ends.
// Between the ends, it is assumed to be linear, because rates only decide where a curve needs more vertices.
Bezier warped_rate(const Bezier &curve, const Bezier &rate, const MapAt &first, const MapAt &last,
                   const BlendedWarp &warp) {
  if (rate.is_point() && rate.control[0] == Vec3{0, 0, 0} && !warp.changes_with_opening()) return rate;
  std::array<Vec3, 4> q{};
  for (int i = 0; i < 4; ++i) {
    const double t = i / 3.0;
    const Vec3 x = evaluate(curve, t), of_x = evaluate(rate, t);
    view(q)[i] = mix(first.along(of_x), last.along(of_x), t) + warp.rate(x);
  }
  return Bezier::cubic(q[0], (1.0 / 6) * (18 * q[1] - 5 * q[0] - 9 * q[2] + 2 * q[3]),
                       (1.0 / 6) * (18 * q[2] - 5 * q[3] - 9 * q[1] + 2 * q[0]), q[3]);
}

// The map at ends of curves. Several curves end at the same place, so the results for the latest places are stored.
class MapAtEnds {
 public:
  explicit MapAtEnds(const BlendedWarp &warp) : warp_(warp) {}

  MapAt operator()(Vec3 p) {
    for (const Place &place : places_)
      if (place.p == p) return place.at;
    const Place made{p, warp_.at(p)};
    if (places_.size() < n_remembered)
      places_.push_back(made);
    else
      places_[next_++ % n_remembered] = made;
    return made.at;
  }

 private:
  static constexpr std::size_t n_remembered = 64;
  struct Place {
    Vec3 p;
    MapAt at;
  };
  const BlendedWarp &warp_;
  Vector<Place> places_;
  std::size_t next_ = 0;
};

// The material points of a curve before any image is placed. The weights belong to the points of a mapped span, and give the
// polynomial through these points.
struct MaterialOfCurve {
  explicit MaterialOfCurve(const Curve &curve) {
    const CurvePoints points(curve, false, material_shares());
    for (std::size_t k = 0; k < n_material; ++k) view(on_curve)[k] = {points.span(k), points.parameter(k)};
    weigh();
  }

  // Returns the same points for the curve after it is cut at these places, which ascend.
  MaterialOfCurve after_cuts(const Vector<PointOnSpan> &cuts) const {
    MaterialOfCurve made = *this;
    for (PointOnSpan &at : made.on_curve) {
      double from = 0, to = 1;  // the part of the span on which the point lies
      std::size_t n_before = 0;
      for (const PointOnSpan &cut : cuts) {
        if (cut.span < at.span || (cut.span == at.span && cut.t <= at.t)) ++n_before;
        if (cut.span != at.span) continue;
        if (cut.t <= at.t) from = cut.t;
        if (cut.t > at.t) to = std::min(to, cut.t);
      }
      at = {at.span + n_before, (at.t - from) / (to - from)};
    }
    made.weigh();
    return made;
  }

  MaterialPoints points_of(const Vector<MappedSpan> &spans) const {
    MaterialPoints made{{}, on_curve, {}, {}};
    for (std::size_t k = 0; k < n_material; ++k) {
      const MappedSpan &mapped = spans[view(on_curve)[k].span];
      Vec3 sum{0, 0, 0};
      for (int i = 0; i <= n_curve_steps; ++i) sum = sum + view(weights[k])[i] * view(mapped)[i];
      view(made.mapped)[k] = sum;
    }
    made.mapped.front() = spans.front().front(), made.mapped.back() = spans.back().back();
    return made;
  }

  std::array<PointOnSpan, n_material> on_curve;
  std::array<double, n_curve_steps + 1> weights[n_material];

 private:
  void weigh() {
    for (std::size_t k = 0; k < n_material; ++k)
      for (int i = 0; i <= n_curve_steps; ++i) {
        double product = 1;
        for (int j = 0; j <= n_curve_steps; ++j)
          if (j != i) product *= (view(on_curve)[k].t * n_curve_steps - j) / (i - j);
        view(weights[k])[i] = product;
      }
  }
};

// Estimates the length of a span between two near parameters by Gauss's rule of 3 points. The rule is the same for both states,
// so that the computed slide is exactly 0 for a point that does not slide.
double length_near(const Bezier &span, double from, double to) {
  const double middle = 0.5 * (from + to), reach = 0.5 * (to - from) * 0.77459666924148337704;
  return (to - from) / 18 *
         (5 * (length(derivative(span, middle - reach)) + length(derivative(span, middle + reach))) +
          8 * length(derivative(span, middle)));
}

// Bends the arcs at the sides of patches of arcs between their warped ends.
void bend_arcs(PatchSet &set) {
  Vector<bool> is_bent(set.curves.size(), false);
  for (const Patch &patch : set.patches) {
    if (patch.bulge == 0) continue;
    const Curve base = along(set, patch.v0);
    for (const bool at_end : {false, true}) {
      const Side &side = at_end ? patch.u1 : patch.u0;
      if (is_bent[side.curve]) continue;
      is_bent[side.curve] = true;
      const Bezier &arc = set.curves[side.curve].spans().front();
      const Vec3 from = side.reversed ? arc.last() : arc.first(), to = side.reversed ? arc.first() : arc.last();
      const Vec3 offset = arc_offset(to - from, base.with_tangent(at_end ? 1 : 0).tangent, patch.bulge);
      const Bezier bent = Bezier::quadratic(from, 0.5 * (from + to) + offset, to);
      set.curves[side.curve] = Curve(side.reversed ? bent.reversed() : bent);
    }
  }
}

// Points of the patches of a set at evenly spaced shares of their sides. `at` gives the places of these shares on a curve.
template <class At>
class EvenPoints {
 public:
  EvenPoints(const PatchSet &set, const At &at) : set_(set), at_(at) {}

  Vec3 point(const Side &side, std::size_t k) const {
    const PointOnSpan &at = place_of(side, k);
    return evaluate(set_.curve_of(side).spans()[at.span], at.t);
  }
  // Returns the offset of the arc at share k. Neighbouring patches have the same bits at a common side.
  Vec3 offset(const Patch &patch, std::size_t k) const {
    if (k == 0 || k == last) return arc_offset(set_, k == 0 ? patch.u0 : patch.u1);
    if (patch.bulge == 0) return {0, 0, 0};
    const PointOnSpan &at = place_of(patch.v0, k);
    const Vec3 along = derivative(set_.curve_of(patch.v0).spans()[at.span], at.t);
    const double speed = length(along);
    if (!(speed > 0)) return {0, 0, 0};
    return arc_offset(point(patch.v1, k) - point(patch.v0, k), ((patch.v0.reversed ? -1 : 1) / speed) * along,
                      patch.bulge);
  }

  static constexpr std::size_t last = n_material - 1;

 private:
  const PointOnSpan &place_of(const Side &side, std::size_t k) const {
    return view(at_(side.curve))[side.reversed ? last - k : k];
  }

  const PatchSet &set_;
  const At &at_;
};

// Points of a patch on an even grid of labels u and v.
class LabelGrid {
 public:
  template <class At>
  LabelGrid(const EvenPoints<At> &even, const Patch &patch, bool has_arcs) {
    constexpr std::size_t step = (n_material - 1) / n_fold_cells;
    std::array<Vec3, n_fold_cells + 1> base, edge, start, end;
    for (std::size_t i = 0; i <= n_fold_cells; ++i) {
      base[i] = even.point(patch.v0, step * i), edge[i] = even.point(patch.v1, step * i);
      if (has_arcs)
        start[i] = even.offset(patch, step * i);
      else
        start[i] = even.point(patch.u0, step * i), end[i] = even.point(patch.u1, step * i);
    }
    for (std::size_t j = 0; j <= n_fold_cells; ++j)
      for (std::size_t i = 0; i <= n_fold_cells; ++i) {
        const double u = material_share(step * i), v = material_share(step * j);
        Vec3 p = mix(base[i], edge[i], v);
        if (has_arcs)
          p = p + 2 * v * (1 - v) * start[i];
        else
          p = p + mix(start[j], end[j], u) -
              mix(mix(base[0], base[n_fold_cells], u), mix(edge[0], edge[n_fold_cells], u), v);
        points_[j * (n_fold_cells + 1) + i] = p;
      }
  }

  const Vec3 &at(std::size_t i, std::size_t j) const { return points_[j * (n_fold_cells + 1) + i]; }

 private:
  std::array<Vec3, (n_fold_cells + 1) * (n_fold_cells + 1)> points_;
};

// Points of a mapped patch on the same grid.
using MappedGrid = std::array<Vec3, (n_fold_cells + 1) * (n_fold_cells + 1)>;

// The normal of a cell. The normal's length is twice the cell's area. Also says whether the cell is too narrow to have a
// meaningful normal.
struct CellNormal {
  // `at` gives the points of the grid. The cell begins at point (i, j).
  template <class At>
  CellNormal(const At &at, std::size_t i, std::size_t j) {
    const Vec3 &p00 = at(i, j), &p10 = at(i + 1, j), &p01 = at(i, j + 1), &p11 = at(i + 1, j + 1);
    normal = cross(p11 - p00, p01 - p10);
    size = length(normal);
    is_sliver = size <= sliver_sine * distance(p11, p00) * distance(p01, p10);
  }

  Vec3 normal;
  double size;
  bool is_sliver;
};

// Maps the inner points of the grid. `image` places the patch before the warp. With FoldCheck::yes, the function fails if the
// warp folds at one of these points.
void map_inner_points(const LabelGrid &before, const PatchImage &image, const BlendedWarp &warp, FoldCheck check,
                      MappedGrid &mapped) {
  for (std::size_t j = 1; j < n_fold_cells; ++j)
    for (std::size_t i = 1; i < n_fold_cells; ++i) {
      const Vec3 p = place(image, before.at(i, j));
      const std::size_t k = j * (n_fold_cells + 1) + i;
      if (check == FoldCheck::no) {
        mapped[k] = warp.value(p);
        continue;
      }
      const MapAt at = warp.at(p);
      if (!(at.determinant() > 0))
        fail(RIIS_INVALID_PARAMETER, "the warp folds at patch ", image.patch_id, " of leaflet ", image.leaflet_id,
             ": its determinant is ", at.determinant(), " at (", p.x, ", ", p.y, ", ", p.z,
             "), in the valve's coordinates; it must be above 0");
      mapped[k] = at.value;
    }
}

// Maps the points of the grid at the patch's sides. Takes the points that were already mapped with the sides' curves.
void map_outer_points(const PatchSet &made, const Patch &patch, const LabelGrid &before, const PatchImage &image,
                      const BlendedWarp &warp, bool has_arcs, MappedGrid &mapped) {
  constexpr std::size_t last = n_material - 1, step = last / n_fold_cells;
  const auto known = [&](const Side &side, std::size_t k) {
    return view(made.material[side.curve]->mapped)[side.reversed ? last - k : k];
  };
  for (std::size_t i = 0; i <= n_fold_cells; ++i) {
    mapped[i] = known(patch.v0, step * i);
    mapped[n_fold_cells * (n_fold_cells + 1) + i] = known(patch.v1, step * i);
  }
  for (std::size_t j = 1; j < n_fold_cells; ++j)
    for (const bool is_end : {false, true}) {
      const std::size_t i = is_end ? n_fold_cells : 0;
      // The known points lie at even shares of a side's length. Along an arc, v is not the share of the length, so these points
      // are mapped anew.
      mapped[j * (n_fold_cells + 1) + i] =
          has_arcs ? warp.value(place(image, before.at(i, j))) : known(is_end ? patch.u1 : patch.u0, step * j);
    }
}

// Fails if a part of the warped patch is turned over relative to the mapped patch. A cell is not checked if it is a sliver before
// the warp, after the warp, or between its mapped corners.
void check_turns(const LabelGrid &before, const PatchImage &image, const LabelGrid &now, const MappedGrid &mapped) {
  const auto at_mapped = [&](std::size_t i, std::size_t j) -> const Vec3 & {
    return mapped[j * (n_fold_cells + 1) + i];
  };
  const auto at_now = [&](std::size_t i, std::size_t j) -> const Vec3 & { return now.at(i, j); };
  const auto at_rest = [&](std::size_t i, std::size_t j) -> const Vec3 & { return before.at(i, j); };
  for (std::size_t j = 0; j < n_fold_cells; ++j)
    for (std::size_t i = 0; i < n_fold_cells; ++i) {
      const CellNormal wanted(at_mapped, i, j), made(at_now, i, j);
      const double product = dot(wanted.normal, made.normal);
      if (product < 0 && !wanted.is_sliver && !made.is_sliver && !CellNormal(at_rest, i, j).is_sliver) {
        const Vec3 p = place(image, before.at(i, j));
        fail(RIIS_INVALID_PARAMETER, "the warp turns a part of patch ", image.patch_id, " of leaflet ",
             image.leaflet_id, " over: near (", p.x, ", ", p.y, ", ", p.z,
             "), in the valve's coordinates, the cosine between the normals is ", product / (wanted.size * made.size),
             "; it must be above 0");
      }
    }
}

PatchSet made_of(Unfolding &unfolding, const PatchSet &set) {
  PatchSet made{{}, std::move(unfolding.patches())};
  made.deviation = set.deviation;
  for (CurveCopy &copy : unfolding.copies()) {
    made.curves.emplace_back(std::move(copy.spans));
    if (!set.rates.empty()) made.rates.push_back(std::move(copy.rates));
  }
  return made;
}

}  // namespace

void locate_on_curve(const Curve &curve, MaterialPoints &points) {
  std::array<double, n_material> behind{};
  for (std::size_t k = 0; k < n_material; ++k) {
    const PointOnSpan &to = view(points.on_curve)[k];
    view(points.point)[k] = curve.at(to);
    if (k == 0) continue;
    const PointOnSpan &from = view(points.on_curve)[k - 1];
    behind[k] = behind[k - 1];
    for (std::size_t span = from.span; span <= to.span; ++span)
      behind[k] += length_near(curve.spans()[span], span == from.span ? from.t : 0, span == to.span ? to.t : 1);
  }
  for (std::size_t k = 0; k < n_material; ++k)
    view(points.share)[k] = curve.length() > 0 ? behind[k] / behind[n_material - 1] : material_share(k);
}

PatchSet without_images(const PatchSet &set) {
  Unfolding unfolding(set);
  return made_of(unfolding, set);
}

PatchSet warped(const PatchSet &set, const BlendedWarp &warp, const LandmarkCuts &cuts, FoldCheck check) {
  Unfolding unfolding(set);
  const Vector<Vector<PointOnSpan>> cuts_of_copies = cuts_by_copy(unfolding, cuts);
  MapAtEnds at_ends(warp);
  Vector<std::optional<MaterialPoints>> material;
  Vector<std::optional<MaterialOfCurve>> of_curves(set.curves.size());
  Vector<MappedSpan> mapped;
  for (std::size_t i = 0; i < unfolding.copies().size(); ++i) {
    CurveCopy &copy = unfolding.copies()[i];
    const Vector<PointOnSpan> &cuts_here = cuts_of_copies[i];
    if (!cuts_here.empty()) copy.spans = cut_at(copy.spans, cuts_here), copy.rates = cut_at(copy.rates, cuts_here);
    MapAt first = at_ends(copy.spans.front().first());
    mapped.clear();
    for (std::size_t k = 0; k < copy.spans.size(); ++k) {
      Bezier &span = copy.spans[k];
      const MapAt last = at_ends(span.last());
      if (!copy.rates.empty()) copy.rates[k] = warped_rate(span, copy.rates[k], first, last, warp);
      mapped.emplace_back();
      span = warped_span(span, first, last, warp, mapped.back());
      first = last;
    }
    std::optional<MaterialOfCurve> &of_curve = of_curves[copy.curve];
    if (!of_curve) of_curve.emplace(set.curves[copy.curve]);
    material.push_back((cuts_here.empty() ? *of_curve : of_curve->after_cuts(cuts_here)).points_of(mapped));
  }
  PatchSet made = made_of(unfolding, set);
  bend_arcs(made);
  for (std::size_t i = 0; i < material.size(); ++i) locate_on_curve(made.curves[i], *material[i]);
  made.material = std::move(material);
  // Only kinds without rates have arcs. The arcs' factors do not show whether there are arcs, because an arc may be straight at
  // one opening.
  const bool has_arcs = set.rates.empty();
  const auto at_rest = [&](std::size_t curve) -> const std::array<PointOnSpan, n_material> & {
    return of_curves[curve]->on_curve;
  };
  const auto at_now = [&](std::size_t curve) -> const std::array<PointOnSpan, n_material> & {
    return made.material[curve]->on_curve;
  };
  const EvenPoints even(set, at_rest);
  const EvenPoints even_now(made, at_now);
  for (const Patch &patch : set.patches) {
    const LabelGrid before(even, patch, has_arcs);
    MappedInside middles{has_arcs, {}};
    for (std::size_t k = 0; has_arcs && k < n_material; ++k)
      view(middles.points)[k] = 0.5 * ((even.point(patch.v0, k) + even.point(patch.v1, k)) + even.offset(patch, k));
    for (const PatchImage &image : patch.images) {
      const Patch &made_patch = made.patches[made.mapped_inside.size()];
      MappedGrid grid;
      if (check == FoldCheck::yes || !has_arcs) map_inner_points(before, image, warp, check, grid);
      if (check == FoldCheck::yes) {
        map_outer_points(made, made_patch, before, image, warp, has_arcs, grid);
        check_turns(before, image, LabelGrid(even_now, made_patch, has_arcs), grid);
      }
      MappedInside inside = middles;
      if (has_arcs)
        for (Vec3 &p : inside.points) p = warp.value(place(image, p));
      else
        for (std::size_t i = 0; i < 4; ++i)
          view(inside.points)[i] = view(grid)[(1 + i / 2) * (n_fold_cells + 1) + 1 + i % 2];
      made.mapped_inside.push_back(inside);
    }
  }
  return made;
}

}  // namespace riis
