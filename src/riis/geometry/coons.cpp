// SPDX-License-Identifier: Apache-2.0
#include "geometry/coons.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "base/errors.hpp"

namespace riis {
namespace {

// Returns the parameters of a side's vertices, or only 0 and 1 if the side is collapsed.
Vector<double> own_parameters(const Polyline &side) { return side.length > 0 ? side.t : Vector<double>{0.0, 1.0}; }

double smallest_step(const Vector<double> &t) {
  double smallest = 1.0;
  for (std::size_t i = 1; i < t.size(); ++i) smallest = std::min(smallest, t[i] - t[i - 1]);
  return smallest;
}

// Bounds the distance between a side and its curve, for each pair of neighbouring grid lines. The bound is a sum: the error of
// the side's segment between the two lines, and the distance by which shared lines shift along the side.
Vector<double> errors_between(const Vector<GridLine> &lines, const Polyline &side, double GridLine::*t) {
  Vector<double> errors(lines.size() - 1, 0.0);
  if (!(side.length > 0)) return errors;
  const auto shift = [&](const GridLine &line) { return side.length * std::abs(line.*t - line.middle); };
  std::size_t segment = 0;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    while (side.t[segment + 1] <= lines[i].*t) ++segment;
    errors[i] = side.errors[segment] + std::max(shift(lines[i]), shift(lines[i + 1]));
  }
  return errors;
}

Vector<GridLine> lines_between(const Polyline &side0, const Polyline &side1, double max_merge_shift) {
  const double longer = std::max(side0.length, side1.length);
  // A grid line that joins two vertices lies at the mean of their parameters. On each side, the end of the line thus moves by at
  // most half the difference of the parameters.
  return merge_parameters(side0, side1, longer > 0 ? 2.0 * max_merge_shift / longer : 0.0);
}

// Adds grid lines between the last line and `to` until O is nearly linear between neighbouring lines.
class ArcRefinement {
 public:
  ArcRefinement(const Bulge &bulge, const ArcLimits &limits, ArcLines &lines)
      : bulge_(bulge), limits_(limits), lines_(lines), last_(bulge.place(lines.u_lines.back().middle)) {}

  void add_up_to(const GridLine &to, const Bulge::Place &place, int depth) {
    if (lines_.u_lines.size() > limits_.max_lines) return;
    const double from = last_.u;
    const double error = bulge_.linear_error(last_, place, limits_.max_error);
    if (error <= limits_.max_error) {
      lines_.u_lines.push_back(to);
      lines_.offsets.push_back(place.offset);
      lines_.errors.push_back(error);
      last_ = place;
      return;
    }
    constexpr int max_depth = 24;
    if (depth == max_depth) {
      const Vec3 where = bulge_.on_base(from);
      fail(RIIS_INVALID_PARAMETER, "near (", where.x, ", ", where.y, ", ", where.z,
           "), before the translation, the line from annulus to free edge runs along the annulus, so surface_angle has "
           "no meaning there: look at the lengths of the leaflets and at the annulus");
    }
    const double u = cut(from, to.middle);
    add_up_to({u, u, u}, bulge_.place(u), depth + 1);
    add_up_to(to, place, depth + 1);
  }

 private:
  // Returns where to cut a range: at a joint that is far enough from both ends, or else in the middle. A cut at a joint removes a
  // kink.
  double cut(double from, double to) const {
    for (const double joint : bulge_.joints())
      if (joint > 0.875 * from + 0.125 * to && joint < 0.125 * from + 0.875 * to) return joint;
    return 0.5 * (from + to);
  }

  const Bulge &bulge_;
  const ArcLimits &limits_;
  ArcLines &lines_;
  Bulge::Place last_;  // the place of the last line
};

}  // namespace

double larger_mix(double at0, double at1, double from, double to) {
  return std::max((1 - from) * at0 + from * at1, (1 - to) * at0 + to * at1);
}

double largest_arc_weight(double from, double to) {
  const double v = std::clamp(0.5, from, to);
  return 2 * v * (1 - v);
}

Vector<double> middles(const Vector<GridLine> &lines) {
  Vector<double> values;
  values.reserve(lines.size());
  for (const GridLine &line : lines) values.push_back(line.middle);
  return values;
}

Vector<GridLine> merge_parameters(const Polyline &side0, const Polyline &side1, double merge_tolerance) {
  const Vector<double> t0 = own_parameters(side0), t1 = own_parameters(side1);
  // The tolerance is small enough that a vertex of one side never matches two vertices of the other side.
  const double tolerance = std::min(merge_tolerance, 0.49 * std::min(smallest_step(t0), smallest_step(t1)));
  Vector<GridLine> lines;
  lines.reserve(t0.size() + t1.size());
  lines.push_back({0.0, 0.0, 0.0, true, true});
  for (std::size_t i = 1, j = 1; i + 1 < t0.size() || j + 1 < t1.size();) {
    // If a side has no further inner vertex, its next parameter is infinity.
    const double a = i + 1 < t0.size() ? t0[i] : std::numeric_limits<double>::infinity();
    const double b = j + 1 < t1.size() ? t1[j] : std::numeric_limits<double>::infinity();
    if (std::abs(a - b) <= tolerance) {
      lines.push_back({a, b, 0.5 * (a + b), true, true});
      ++i, ++j;
    } else if (a < b) {
      lines.push_back({a, a, a, true, false});
      ++i;
    } else {
      lines.push_back({b, b, b, false, true});
      ++j;
    }
  }
  lines.push_back({1.0, 1.0, 1.0, true, true});
  return lines;
}

Vector<Vec3> coons_combination(const Vector<double> &u, const Vector<double> &v, const SideVectors &sides) {
  const std::size_t n_u = u.size(), n_v = v.size();
  const Vec3 p00 = sides.v0.front(), p10 = sides.v0.back(), p01 = sides.v1.front(), p11 = sides.v1.back();
  struct Chords {
    Vec3 at_v0, at_v1;
  };
  Vector<Chords> chords;
  chords.reserve(n_u);
  for (const double at : u) chords.push_back({mix(p00, p10, at), mix(p01, p11, at)});
  // On the boundary, the result is exactly the sides' vectors, because neighbouring patches share the sides.
  Vector<Vec3> made;
  made.reserve(n_u * n_v);
  made.insert(made.end(), sides.v0.begin(), sides.v0.end());
  for (std::size_t j = 1; j + 1 < n_v; ++j) {
    const Vec3 at_u0 = sides.u0[j], at_u1 = sides.u1[j];
    made.push_back(at_u0);
    for (std::size_t i = 1; i + 1 < n_u; ++i)
      made.push_back(mix(sides.v0[i], sides.v1[i], v[j]) + mix(at_u0, at_u1, u[i]) -
                     mix(chords[i].at_v0, chords[i].at_v1, v[j]));
    made.push_back(at_u1);
  }
  made.insert(made.end(), sides.v1.begin(), sides.v1.end());
  return made;
}

QuadGrid make_quad_grid(const PatchSides &sides, double max_merge_shift, GridLines *lines) {
  GridLines made{lines_between(*sides.side_v0, *sides.side_v1, max_merge_shift),
                 lines_between(*sides.side_u0, *sides.side_u1, max_merge_shift)};
  QuadGrid grid = make_quad_grid(sides, made);
  if (lines) *lines = std::move(made);
  return grid;
}

QuadGrid make_quad_grid(const PatchSides &sides, const GridLines &lines) {
  const Vector<GridLine> &u_lines = lines.u, &v_lines = lines.v;
  QuadGrid grid{middles(u_lines), middles(v_lines), {}, {}};
  SideVectors sides_on_lines;
  for (auto *vectors : {&sides_on_lines.v0, &sides_on_lines.v1}) vectors->reserve(u_lines.size());
  for (auto *vectors : {&sides_on_lines.u0, &sides_on_lines.u1}) vectors->reserve(v_lines.size());
  for (const GridLine &line : u_lines) {
    sides_on_lines.v0.push_back(evaluate(*sides.side_v0, line.t0));
    sides_on_lines.v1.push_back(evaluate(*sides.side_v1, line.t1));
  }
  for (const GridLine &line : v_lines) {
    sides_on_lines.u0.push_back(evaluate(*sides.side_u0, line.t0));
    sides_on_lines.u1.push_back(evaluate(*sides.side_u1, line.t1));
  }
  grid.points = coons_combination(grid.u, grid.v, sides_on_lines);
  // The error of a point of the patch is a weighted sum of the errors of four side points. The weights follow from the point's
  // position.
  const Vector<double> error_v0 = errors_between(u_lines, *sides.side_v0, &GridLine::t0);
  const Vector<double> error_v1 = errors_between(u_lines, *sides.side_v1, &GridLine::t1);
  const Vector<double> error_u0 = errors_between(v_lines, *sides.side_u0, &GridLine::t0);
  const Vector<double> error_u1 = errors_between(v_lines, *sides.side_u1, &GridLine::t1);
  grid.errors.reserve(error_v0.size() * error_u0.size());
  for (std::size_t j = 0; j < error_u0.size(); ++j)
    for (std::size_t i = 0; i < error_v0.size(); ++i)
      grid.errors.push_back(larger_mix(error_v0[i], error_v1[i], grid.v[j], grid.v[j + 1]) +
                            larger_mix(error_u0[j], error_u1[j], grid.u[i], grid.u[i + 1]));
  return grid;
}

double ArcLines::largest_offset() const {
  double largest = 0;
  for (const Vec3 &offset : offsets) largest = std::max(largest, length(offset));
  return largest;
}

ArcLines make_arc_lines(const PatchSides &sides, const Bulge &bulge, Vec3 offset_u0, Vec3 offset_u1,
                        const ArcLimits &limits) {
  const Vector<GridLine> given = lines_between(*sides.side_v0, *sides.side_v1, limits.max_merge_shift);
  ArcLines lines{{given.front()}, {offset_u0}, {}};
  ArcRefinement refinement(bulge, limits, lines);
  for (std::size_t i = 1; i < given.size(); ++i) {
    Bulge::Place place = bulge.place(given[i].middle);
    if (i + 1 == given.size()) place.offset = offset_u1;
    refinement.add_up_to(given[i], place, 0);
  }
  return lines;
}

QuadGrid make_arc_grid(const PatchSides &sides, const ArcLines &lines, std::size_t n_rows) {
  QuadGrid grid{middles(lines.u_lines), {}, {}, {}};
  grid.v.reserve(n_rows + 1);
  for (std::size_t j = 0; j <= n_rows; ++j) grid.v.push_back(static_cast<double>(j) / static_cast<double>(n_rows));
  Vector<Vec3> base, edge;
  base.reserve(lines.u_lines.size());
  edge.reserve(lines.u_lines.size());
  for (const GridLine &line : lines.u_lines) {
    base.push_back(evaluate(*sides.side_v0, line.t0));
    edge.push_back(evaluate(*sides.side_v1, line.t1));
  }
  grid.points.reserve(base.size() * grid.v.size());
  grid.points = base;
  for (std::size_t j = 1; j < n_rows; ++j) {
    const double v = grid.v[j];
    for (std::size_t i = 0; i < base.size(); ++i)
      grid.points.push_back(mix(base[i], edge[i], v) + (2 * v * (1 - v)) * lines.offsets[i]);
  }
  grid.points.insert(grid.points.end(), edge.begin(), edge.end());

  // Between two lines, the errors of base, edge and O are their distances from linear interpolation. On a line, the distance of
  // the chords from the arc is |O| / 2 times the square of the row's height.
  const Vector<double> base_errors = errors_between(lines.u_lines, *sides.side_v0, &GridLine::t0);
  const Vector<double> edge_errors = errors_between(lines.u_lines, *sides.side_v1, &GridLine::t1);
  const double row = 1 / static_cast<double>(n_rows);
  Vector<double> chord_errors;
  chord_errors.reserve(base_errors.size());
  for (std::size_t i = 0; i < base_errors.size(); ++i)
    chord_errors.push_back(0.5 * row * row * std::max(length(lines.offsets[i]), length(lines.offsets[i + 1])));
  grid.errors.reserve(base_errors.size() * n_rows);
  for (std::size_t j = 0; j < n_rows; ++j) {
    const double weight = largest_arc_weight(grid.v[j], grid.v[j + 1]);
    for (std::size_t i = 0; i < base_errors.size(); ++i)
      grid.errors.push_back(larger_mix(base_errors[i], edge_errors[i], grid.v[j], grid.v[j + 1]) +
                            weight * lines.errors[i] + chord_errors[i]);
  }
  return grid;
}

GridLines lines_of_arc_grid(const ArcLines &lines, const QuadGrid &grid) {
  GridLines made{lines.u_lines, {}};
  for (const double v : grid.v) made.v.push_back({v, v, v});
  return made;
}

std::size_t interval_of(const Vector<double> &values, double x) {
  const auto after = std::upper_bound(values.begin(), values.end(), x);
  const auto i = static_cast<std::size_t>(std::distance(values.begin(), after));
  return std::clamp<std::size_t>(i, 1, values.size() - 1) - 1;
}

Vec3 evaluate(const QuadGrid &grid, double u, double v) {
  const std::size_t i = interval_of(grid.u, u), j = interval_of(grid.v, v);
  const double du = (u - grid.u[i]) / (grid.u[i + 1] - grid.u[i]);
  const double dv = (v - grid.v[j]) / (grid.v[j + 1] - grid.v[j]);
  return mix(mix(grid.point(i, j), grid.point(i + 1, j), du), mix(grid.point(i, j + 1), grid.point(i + 1, j + 1), du),
             dv);
}

}  // namespace riis
