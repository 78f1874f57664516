// SPDX-License-Identifier: Apache-2.0
#include "measures/plane_cover.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "common/array_view.hpp"
#include "common/elementary.hpp"

namespace riis {
namespace {

// One end of an interval on a line. An edge passes through this end. `along` is the length of the edge between two lines
// with spacing 1. The length is 0 if lines in the other direction measure the edge.
struct End {
  double x, along;
};

struct Interval {
  End begin, end;
};

// The outline is cut into n strips of equal height. One line along x lies in the middle of each strip.
class ScanLines {
 public:
  ScanLines(const Outline &outline, std::int64_t n) : n_(n) {
    if (outline.radius > 0) {
      bottom_ = outline.centre[1] - outline.radius, top_ = outline.centre[1] + outline.radius;
      return;
    }
    for (const auto &edge : outline.edges)
      for (const PlanePoint &p : edge) bottom_ = std::min(bottom_, p[1]), top_ = std::max(top_, p[1]);
  }
  std::int64_t n() const { return n_; }
  double spacing() const { return (top_ - bottom_) / static_cast<double>(n_); }
  double y(std::int64_t i) const { return bottom_ + (static_cast<double>(i) + 0.5) * spacing(); }
  // Returns the first line at or above y, or n if there is none.
  std::int64_t first_from(double y) const {
    const double place = std::ceil((y - bottom_) / spacing() - 0.5);
    return static_cast<std::int64_t>(std::clamp(place, 0.0, static_cast<double>(n_)));
  }

 private:
  std::int64_t n_;
  double bottom_ = std::numeric_limits<double>::infinity(), top_ = -bottom_;
};

double x_at(const PlanePoint &a, const PlanePoint &b, double y) {
  return a[0] + (b[0] - a[0]) * ((y - a[1]) / (b[1] - a[1]));
}

// Returns the length of an edge between two lines with spacing 1. Returns 0 for a flat edge, because lines in the other direction
// measure it. An edge at 45 degrees counts only if counts_equal is true, which holds for the lines along x.
double length_along(double dx, double dy, bool counts_equal) {
  const double across = std::abs(dy), beside = std::abs(dx);
  if (across < beside || (across == beside && !counts_equal)) return 0;
  const double slope = beside / across;
  return std::sqrt(1 + slope * slope);
}

// Calls visit(i, x) for each line that the edge meets. A line through the upper end does not count. The order of a and b does
// not change x, so two triangles with a common edge leave no gap.
template <class Visit>
void for_each_cut(const ScanLines &lines, PlanePoint a, PlanePoint b, const Visit &visit) {
  if (b[1] < a[1]) std::swap(a, b);
  const std::int64_t end = lines.first_from(b[1]);
  for (std::int64_t i = lines.first_from(a[1]); i < end; ++i) visit(i, x_at(a, b, lines.y(i)));
}

using IntervalsOfLines = std::vector<std::vector<Interval>>;

IntervalsOfLines circle_spans(const Outline &circle, const ScanLines &lines) {
  IntervalsOfLines intervals(static_cast<std::size_t>(lines.n()));
  for (std::int64_t i = 0; i < lines.n(); ++i) {
    const double y = lines.y(i) - circle.centre[1];
    const double half = std::sqrt(std::max(0.0, (circle.radius - y) * (circle.radius + y)));
    view(intervals)[i].push_back({{circle.centre[0] - half, 0}, {circle.centre[0] + half, 0}});
  }
  return intervals;
}

IntervalsOfLines inside(const Outline &outline, const ScanLines &lines) {
  if (outline.radius > 0) return circle_spans(outline, lines);
  std::vector<std::vector<double>> cuts(static_cast<std::size_t>(lines.n()));
  for (const auto &[a, b] : outline.edges)
    for_each_cut(lines, a, b, [&](std::int64_t i, double x) { view(cuts)[i].push_back(x); });
  IntervalsOfLines intervals(cuts.size());
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    std::sort(cuts[i].begin(), cuts[i].end());
    for (std::size_t k = 1; k < cuts[i].size(); k += 2) intervals[i].push_back({{cuts[i][k - 1], 0}, {cuts[i][k], 0}});
  }
  return intervals;
}

// Collects the intervals of convex shapes on the lines. A convex shape meets a line in at most one interval.
class Covered {
 public:
  Covered(const ScanLines &lines, bool counts_equal)
      : intervals(static_cast<std::size_t>(lines.n())),
        lines_(lines),
        counts_equal_(counts_equal),
        of_shape_(intervals.size(), -1) {}

  void begin_shape() { ++shape_; }

  void add_edge(const PlanePoint &a, const PlanePoint &b) {
    const double along = length_along(b[0] - a[0], b[1] - a[1], counts_equal_);
    for_each_cut(lines_, a, b, [&](std::int64_t i, double x) { widen(i, {x, along}); });
  }

  void add_disc(const PlanePoint &centre, double radius) {
    const std::int64_t end = lines_.first_from(centre[1] + radius);
    for (std::int64_t i = lines_.first_from(centre[1] - radius); i < end; ++i) {
      const double y = lines_.y(i) - centre[1];
      const double half = std::sqrt(std::max(0.0, (radius - y) * (radius + y)));
      const double along = length_along(y, half, counts_equal_);  // a circle runs at right angles to its radius (half,
                                                                  // y)
      widen(i, {centre[0] - half, along});
      widen(i, {centre[0] + half, along});
    }
  }

  IntervalsOfLines intervals;

 private:
  void widen(std::int64_t i, const End &at) {
    if (view(of_shape_)[i] != shape_) {
      view(of_shape_)[i] = shape_;
      view(intervals)[i].push_back({at, at});
      return;
    }
    Interval &interval = view(intervals)[i].back();
    if (at.x < interval.begin.x) interval.begin = at;
    if (at.x > interval.end.x) interval.end = at;
  }

  const ScanLines &lines_;
  bool counts_equal_;
  std::vector<std::int64_t> of_shape_;
  std::int64_t shape_ = -1;
};

// Returns the intervals within `reach` of the triangles. Their points lie in a triangle, or within `reach` of the rim.
IntervalsOfLines covered(const Cover &cover, double reach, const ScanLines &lines, bool counts_equal) {
  Covered made(lines, counts_equal);
  for (const PlaneTriangle &corner : cover.triangles) {
    made.begin_shape();
    for (std::size_t k = 0; k < 3; ++k) made.add_edge(corner[k], corner[(k + 1) % 3]);
  }
  if (!(reach > 0)) return std::move(made.intervals);
  for (const auto &[a, b] : cover.rim) {
    const double dx = b[0] - a[0], dy = b[1] - a[1], size = hypotenuse(dx, dy);
    made.begin_shape();
    made.add_disc(a, reach);
    made.add_disc(b, reach);
    if (!(size > 0)) continue;
    for (const double aside : {reach / size, -reach / size}) {
      const double x = -aside * dy, y = aside * dx;
      made.add_edge({a[0] + x, a[1] + y}, {b[0] + x, b[1] + y});
    }
  }
  return std::move(made.intervals);
}

double total(const std::vector<Interval> &intervals) {
  double sum = 0;
  for (const Interval &interval : intervals) sum += interval.end.x - interval.begin.x;
  return sum;
}

struct Uncovered {
  double length = 0, edge = 0;
};

// Measures the part of disjoint intervals that no cover contains. Also measures the edges of the covers at the ends of this part.
Uncovered without(const std::vector<Interval> &intervals, std::vector<Interval> covers) {
  // Covers of folded leaflets may begin or end in one point. Their order then says which edge counts, so it is total.
  std::sort(covers.begin(), covers.end(), [](const Interval &a, const Interval &b) {
    return std::tie(a.begin.x, a.end.x, a.begin.along, a.end.along) <
           std::tie(b.begin.x, b.end.x, b.begin.along, b.end.along);
  });
  Uncovered made;
  for (const Interval &interval : intervals) {
    End at{interval.begin.x, 0};
    for (const Interval &cover : covers) {
      if (cover.begin.x >= interval.end.x) break;
      if (cover.begin.x > at.x) {
        made.length += cover.begin.x - at.x;
        made.edge += at.along + cover.begin.along;
      }
      if (cover.end.x > at.x) at = cover.end;
    }
    if (at.x < interval.end.x) {
      made.length += interval.end.x - at.x;
      made.edge += at.along;
    }
  }
  return made;
}

Uncovered uncovered(const Outline &outline, const Cover &cover, double reach, std::int64_t n_lines, bool counts_equal) {
  const ScanLines lines(outline, n_lines);
  const IntervalsOfLines insides = inside(outline, lines);
  IntervalsOfLines covers = covered(cover, reach, lines, counts_equal);
  Uncovered sum;
  for (std::size_t i = 0; i < insides.size(); ++i) {
    const Uncovered of_line = without(insides[i], std::move(covers[i]));
    sum.length += of_line.length;
    sum.edge += of_line.edge;
  }
  return {sum.length * lines.spacing(), sum.edge * lines.spacing()};
}

PlanePoint swapped(const PlanePoint &p) { return {p[1], p[0]}; }

Outline swapped(const Outline &outline) {
  Outline made{outline.radius, swapped(outline.centre), {}};
  for (const auto &[a, b] : outline.edges) made.edges.push_back({swapped(a), swapped(b)});
  return made;
}

Cover swapped(const Cover &cover) {
  Cover made;
  for (const auto &[a, b, c] : cover.triangles) made.triangles.push_back({swapped(a), swapped(b), swapped(c)});
  for (const auto &[a, b] : cover.rim) made.rim.push_back({swapped(a), swapped(b)});
  return made;
}

// Returns false if the lines enclose an area only by rounding, such as lines seen edge on.
bool has_area(const Outline &outline, double rounding) {
  const double height = ScanLines(outline, 1).spacing(), width = ScanLines(swapped(outline), 1).spacing();
  const double size = std::max(height, width);
  return height > 0 && area_of(outline) > std::max(1e-9 * size, rounding) * size;
}

// Returns 1 or -1 for the side of the triangle that faces the viewer, and 0 if the viewer sees only its edge.
int side_of(const PlaneTriangle &corner) {
  const auto &[a, b, c] = corner;
  const double first = (b[0] - a[0]) * (c[1] - a[1]), second = (b[1] - a[1]) * (c[0] - a[0]);
  constexpr double rounding = 1e-12;
  if (std::abs(first - second) <= rounding * (std::abs(first) + std::abs(second))) return 0;
  return first > second ? 1 : -1;
}

}  // namespace

Outline circle(double radius, const PlanePoint &centre) { return {radius, centre, {}}; }

std::optional<Outline> closed_outline(const std::vector<std::vector<PlanePoint>> &lines, double rounding) {
  Outline outline;
  std::map<PlanePoint, int> n_ends;
  for (const auto &line : lines) {
    for (std::size_t i = 1; i < line.size(); ++i) outline.edges.push_back({line[i - 1], line[i]});
    for (const PlanePoint &end : {line.front(), line.back()}) ++n_ends[end];
  }
  const bool is_closed = std::all_of(n_ends.begin(), n_ends.end(), [](const auto &end) { return end.second % 2 == 0; });
  if (lines.empty() || !is_closed || !has_area(outline, rounding)) return std::nullopt;
  return outline;
}

Cover cover_of(const std::vector<PlanePoint> &vertices, const std::vector<std::int64_t> &vertex_id) {
  // An edge of the triangles. `sides` is the sum of side_of over the edge's triangles. It is 2 or -2 if two triangles lie on
  // opposite sides of the edge.
  struct Use {
    int n = 0, sides = 0;
  };
  std::unordered_map<std::uint64_t, Use> uses;
  uses.reserve(vertex_id.size());
  const auto key = [](std::int64_t a, std::int64_t b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint64_t>(std::max(a, b));
  };
  const auto n = view(vertex_id).size() / 3;
  const auto id = [&](std::int64_t triangle, std::int64_t k) { return view(vertex_id)[3 * triangle + k % 3]; };
  Cover cover;
  cover.triangles.reserve(vertex_id.size() / 3);
  for (std::int64_t i = 0; i < n; ++i) {
    cover.triangles.push_back({view(vertices)[id(i, 0)], view(vertices)[id(i, 1)], view(vertices)[id(i, 2)]});
    const int side = side_of(cover.triangles.back());
    for (int k = 0; k < 3; ++k) {
      Use &use = uses[key(id(i, k), id(i, k + 1))];
      ++use.n;
      use.sides += side;
    }
  }
  for (std::int64_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      Use &use = uses[key(id(i, k), id(i, k + 1))];
      if (use.n < 1 || (use.n == 2 && std::abs(use.sides) == 2)) continue;
      use.n = -1;  // the second triangle of this edge does not add the edge again
      cover.rim.push_back({view(vertices)[id(i, k)], view(vertices)[id(i, k + 1)]});
    }
  return cover;
}

double area_of(const Outline &outline, std::int64_t n_lines) {
  const ScanLines lines(outline, n_lines);
  double length = 0;
  for (const auto &intervals : inside(outline, lines)) length += total(intervals);
  return length * lines.spacing();
}

double uncovered_area(const Outline &outline, const Cover &cover, double reach, std::int64_t n_lines) {
  return uncovered(outline, cover, reach, n_lines, true).length;
}

double uncovered_edge(const Outline &outline, const Cover &cover, double reach, std::int64_t n_lines) {
  return uncovered(outline, cover, reach, n_lines, true).edge +
         uncovered(swapped(outline), swapped(cover), reach, n_lines, false).edge;
}

}  // namespace riis
