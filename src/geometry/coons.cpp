// SPDX-License-Identifier: Apache-2.0
#include "geometry/coons.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace riis {
namespace {

// The parameters that a side contributes: none but the ends if it is collapsed.
std::vector<double> own_parameters(const Polyline &side) {
  return side.length > 0 ? side.t : std::vector<double>{0.0, 1.0};
}

double smallest_step(const std::vector<double> &t) {
  double smallest = 1.0;
  for (std::size_t i = 1; i < t.size(); ++i) smallest = std::min(smallest, t[i] - t[i - 1]);
  return smallest;
}

std::vector<double> middles(const std::vector<GridLine> &lines) {
  std::vector<double> values;
  values.reserve(lines.size());
  for (const GridLine &line : lines) values.push_back(line.middle);
  return values;
}

// How far a side may be from its curve between each two grid lines: the error of the segment there, and the shift of shared lines
// along the side.
std::vector<double> errors_between(const std::vector<GridLine> &lines, const Polyline &side, double GridLine::*t) {
  std::vector<double> errors(lines.size() - 1, 0.0);
  if (!(side.length > 0)) return errors;
  const auto shift = [&](const GridLine &line) { return side.length * std::abs(line.*t - line.middle); };
  std::size_t segment = 0;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    while (side.t[segment + 1] <= lines[i].*t) ++segment;
    errors[i] = side.errors[segment] + std::max(shift(lines[i]), shift(lines[i + 1]));
  }
  return errors;
}

// The larger value at two ends of what is linear between them.
double larger_mix(double at0, double at1, double from, double to) {
  return std::max((1 - from) * at0 + from * at1, (1 - to) * at0 + to * at1);
}

// Index of the interval of ascending values that holds x: the last one at the upper end.
std::size_t interval(const std::vector<double> &values, double x) {
  const auto after = std::upper_bound(values.begin(), values.end(), x);
  const auto i = static_cast<std::size_t>(std::distance(values.begin(), after));
  return std::clamp<std::size_t>(i, 1, values.size() - 1) - 1;
}

}  // namespace

std::vector<GridLine> merge_parameters(const Polyline &side0, const Polyline &side1, double merge_tolerance) {
  const std::vector<double> t0 = own_parameters(side0), t1 = own_parameters(side1);
  // Never so wide that two vertices of one side compete for a partner.
  const double tolerance = std::min(merge_tolerance, 0.49 * std::min(smallest_step(t0), smallest_step(t1)));
  std::vector<GridLine> lines{{0.0, 0.0, 0.0}};
  for (std::size_t i = 1, j = 1; i + 1 < t0.size() || j + 1 < t1.size();) {
    // Past the last inner vertex of a side its parameter is out of reach.
    const double a = i + 1 < t0.size() ? t0[i] : std::numeric_limits<double>::infinity();
    const double b = j + 1 < t1.size() ? t1[j] : std::numeric_limits<double>::infinity();
    if (std::abs(a - b) <= tolerance) {
      lines.push_back({a, b, 0.5 * (a + b)});
      ++i, ++j;
    } else if (a < b) {
      lines.push_back({a, a, a});
      ++i;
    } else {
      lines.push_back({b, b, b});
      ++j;
    }
  }
  lines.push_back({1.0, 1.0, 1.0});
  return lines;
}

QuadGrid make_quad_grid(const PatchSides &sides, double max_merge_shift) {
  const auto lines = [&](const Polyline &side0, const Polyline &side1) {
    const double longer = std::max(side0.length, side1.length);
    // Each side moves by at most half the difference of the parameters, since the line stands at their mean.
    return merge_parameters(side0, side1, longer > 0 ? 2.0 * max_merge_shift / longer : 0.0);
  };
  const std::vector<GridLine> u_lines = lines(*sides.side_v0, *sides.side_v1);
  const std::vector<GridLine> v_lines = lines(*sides.side_u0, *sides.side_u1);

  QuadGrid grid{middles(u_lines), middles(v_lines), {}, {}};
  grid.points.reserve(u_lines.size() * v_lines.size());
  const Vec3 p00 = sides.side_v0->points.front(), p10 = sides.side_v0->points.back();
  const Vec3 p01 = sides.side_v1->points.front(), p11 = sides.side_v1->points.back();
  for (std::size_t j = 0; j < v_lines.size(); ++j) {
    const double v = v_lines[j].middle;
    const Vec3 left = evaluate(*sides.side_u0, v_lines[j].t0), right = evaluate(*sides.side_u1, v_lines[j].t1);
    for (std::size_t i = 0; i < u_lines.size(); ++i) {
      const double u = u_lines[i].middle;
      const Vec3 bottom = evaluate(*sides.side_v0, u_lines[i].t0), top = evaluate(*sides.side_v1, u_lines[i].t1);
      // The boundary is the polylines' own, to the last bit: neighbouring patches share it.
      if (j == 0)
        grid.points.push_back(bottom);
      else if (j + 1 == v_lines.size())
        grid.points.push_back(top);
      else if (i == 0)
        grid.points.push_back(left);
      else if (i + 1 == u_lines.size())
        grid.points.push_back(right);
      else
        grid.points.push_back(mix(bottom, top, v) + mix(left, right, u) - mix(mix(p00, p10, u), mix(p01, p11, u), v));
    }
  }
  // A point of the patch inherits the errors of its four side points with their weights.
  const std::vector<double> error_v0 = errors_between(u_lines, *sides.side_v0, &GridLine::t0);
  const std::vector<double> error_v1 = errors_between(u_lines, *sides.side_v1, &GridLine::t1);
  const std::vector<double> error_u0 = errors_between(v_lines, *sides.side_u0, &GridLine::t0);
  const std::vector<double> error_u1 = errors_between(v_lines, *sides.side_u1, &GridLine::t1);
  grid.errors.reserve(error_v0.size() * error_u0.size());
  for (std::size_t j = 0; j < error_u0.size(); ++j)
    for (std::size_t i = 0; i < error_v0.size(); ++i)
      grid.errors.push_back(larger_mix(error_v0[i], error_v1[i], grid.v[j], grid.v[j + 1]) +
                            larger_mix(error_u0[j], error_u1[j], grid.u[i], grid.u[i + 1]));
  return grid;
}

Vec3 evaluate(const QuadGrid &grid, double u, double v) {
  const std::size_t i = interval(grid.u, u), j = interval(grid.v, v);
  const double du = (u - grid.u[i]) / (grid.u[i + 1] - grid.u[i]);
  const double dv = (v - grid.v[j]) / (grid.v[j + 1] - grid.v[j]);
  return mix(mix(grid.point(i, j), grid.point(i + 1, j), du), mix(grid.point(i, j + 1), grid.point(i + 1, j + 1), du),
             dv);
}

}  // namespace riis
