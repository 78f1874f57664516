// SPDX-License-Identifier: Apache-2.0
#include "measures/plane_cover.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <type_traits>
#include <unordered_map>
#include <utility>

#include "common/array_view.hpp"
#include "common/elementary.hpp"

namespace riis {
namespace {

// The end of an interval on a line, where an edge crosses the line. `along` is the length of the edge from one line to the next,
// as a multiple of the spacing. `along` is 0 if the edge is measured by the lines in the other direction instead.
struct End {
  double x, along;
};

// The end of an interval on a line, if only areas are measured.
struct Place {
  double x;
};

template <class AnEnd>
struct Interval {
  AnEnd begin, end;
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

// Returns the length of an edge from one line to the next, as a multiple of the spacing. Returns 0 for a flat edge, because the
// lines in the other direction measure such an edge. An edge at exactly 45 degrees is measured only if counts_equal is true,
// which is the case for the lines along x.
double length_along(double dx, double dy, bool counts_equal) {
  const double across = std::abs(dy), beside = std::abs(dx);
  if (across < beside || (across == beside && !counts_equal)) return 0;
  const double slope = beside / across;
  return std::sqrt(1 + slope * slope);
}

// Calls visit(i, x) for each line that the edge meets, except for a line through the upper end. The value of x does not depend on
// the order of the edge's ends. Two triangles with a common edge therefore leave no gap.
template <class Visit>
void for_each_cut(const ScanLines &lines, PlanePoint a, PlanePoint b, const Visit &visit) {
  if (b[1] < a[1]) std::swap(a, b);
  const std::int64_t end = lines.first_from(b[1]);
  for (std::int64_t i = lines.first_from(a[1]); i < end; ++i) visit(i, x_at(a, b, lines.y(i)));
}

template <class AnEnd>
using IntervalsOfLines = std::vector<std::vector<Interval<AnEnd>>>;
using Spans = std::vector<Interval<Place>>;
using SpansOfLines = std::vector<Spans>;

SpansOfLines circle_spans(const Outline &circle, const ScanLines &lines) {
  SpansOfLines spans(static_cast<std::size_t>(lines.n()));
  for (std::int64_t i = 0; i < lines.n(); ++i) {
    const double y = lines.y(i) - circle.centre[1];
    const double half = std::sqrt(std::max(0.0, (circle.radius - y) * (circle.radius + y)));
    view(spans)[i].push_back({{circle.centre[0] - half}, {circle.centre[0] + half}});
  }
  return spans;
}

SpansOfLines inside(const Outline &outline, const ScanLines &lines) {
  if (outline.radius > 0) return circle_spans(outline, lines);
  std::vector<std::vector<double>> cuts(static_cast<std::size_t>(lines.n()));
  for (const auto &[a, b] : outline.edges)
    for_each_cut(lines, a, b, [&](std::int64_t i, double x) { view(cuts)[i].push_back(x); });
  SpansOfLines spans(cuts.size());
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    std::sort(cuts[i].begin(), cuts[i].end());
    for (std::size_t k = 1; k < cuts[i].size(); k += 2) spans[i].push_back({{cuts[i][k - 1]}, {cuts[i][k]}});
  }
  return spans;
}

// Collects the intervals of convex shapes on the lines. A convex shape meets a line in at most one interval. If only areas are
// measured, intervals of successive shapes that meet are joined at once, so that fewer intervals have to be sorted.
template <class AnEnd>
class Covered {
 public:
  Covered(const ScanLines &lines, bool counts_equal)
      : intervals(static_cast<std::size_t>(lines.n())),
        lines_(lines),
        counts_equal_(counts_equal),
        of_shape_(intervals.size(), -1) {}

  void add_triangles(const Cover &cover) {
    for (const PlaneTriangle &corner : cover.triangles) {
      ++shape_;
      for (std::size_t k = 0; k < 3; ++k) add_edge(corner[k], corner[(k + 1) % 3]);
    }
  }

  // Adds the points within `reach` of the rim.
  void add_rim(const Cover &cover, double reach) {
    if (!(reach > 0)) return;
    for (const auto &[a, b] : cover.rim) {
      const double dx = b[0] - a[0], dy = b[1] - a[1], size = hypotenuse(dx, dy);
      ++shape_;
      add_disc(a, reach);
      add_disc(b, reach);
      if (!(size > 0)) continue;
      for (const double aside : {reach / size, -reach / size}) {
        const double x = -aside * dy, y = aside * dx;
        add_edge({a[0] + x, a[1] + y}, {b[0] + x, b[1] + y});
      }
    }
  }

  IntervalsOfLines<AnEnd> intervals;

 private:
  static constexpr bool has_edges = std::is_same_v<AnEnd, End>;

  // Returns the end of an interval at x, where an edge with the direction (dx, dy) crosses the line.
  AnEnd end_at(double x, double dx, double dy) const {
    if constexpr (has_edges)
      return {x, length_along(dx, dy, counts_equal_)};
    else
      return {x};
  }

  void add_edge(const PlanePoint &a, const PlanePoint &b) {
    AnEnd end = end_at(0, b[0] - a[0], b[1] - a[1]);
    for_each_cut(lines_, a, b, [&](std::int64_t i, double x) {
      end.x = x;
      widen(i, end);
    });
  }

  void add_disc(const PlanePoint &centre, double radius) {
    const std::int64_t end = lines_.first_from(centre[1] + radius);
    for (std::int64_t i = lines_.first_from(centre[1] - radius); i < end; ++i) {
      const double y = lines_.y(i) - centre[1];
      const double half = std::sqrt(std::max(0.0, (radius - y) * (radius + y)));
      // The direction of a circle is at right angles to the radius, which is (half, y) here.
      AnEnd at = end_at(centre[0] - half, y, half);
      widen(i, at);
      at.x = centre[0] + half;
      widen(i, at);
    }
  }

  void widen(std::int64_t i, const AnEnd &at) {
    std::vector<Interval<AnEnd>> &line = view(intervals)[i];
    if (view(of_shape_)[i] != shape_) {
      view(of_shape_)[i] = shape_;
      if constexpr (!has_edges) join_last(line);
      line.push_back({at, at});
      return;
    }
    Interval<AnEnd> &interval = line.back();
    if (at.x < interval.begin.x) interval.begin = at;
    if (at.x > interval.end.x) interval.end = at;
  }

  static void join_last(Spans &line) {
    if (line.size() < 2) return;
    const Interval<Place> last = line.back();
    Interval<Place> &before = line[line.size() - 2];
    if (last.begin.x > before.end.x || last.end.x < before.begin.x) return;
    before = {{std::min(before.begin.x, last.begin.x)}, {std::max(before.end.x, last.end.x)}};
    line.pop_back();
  }

  const ScanLines &lines_;
  bool counts_equal_;
  std::vector<std::int64_t> of_shape_;
  std::int64_t shape_ = -1;
};

double total(const Spans &spans) {
  double sum = 0;
  for (const Interval<Place> &span : spans) sum += span.end.x - span.begin.x;
  return sum;
}

// Sorts the spans, and joins spans that meet.
void join(Spans &spans) {
  std::sort(spans.begin(), spans.end(),
            [](const Interval<Place> &a, const Interval<Place> &b) { return a.begin.x < b.begin.x; });
  std::size_t n = 0;
  for (const Interval<Place> &span : spans) {
    if (n > 0 && span.begin.x <= spans[n - 1].end.x)
      spans[n - 1].end.x = std::max(spans[n - 1].end.x, span.end.x);
    else
      spans[n++] = span;
  }
  spans.resize(n);
}

// Returns the length of the part of the spans that no cover contains. The spans must be disjoint, and the covers must have been
// joined.
double length_without(const Spans &spans, const Spans &covers) {
  double length = 0;
  for (const Interval<Place> &span : spans) {
    double at = span.begin.x;
    for (const Interval<Place> &cover : covers) {
      if (cover.begin.x >= span.end.x) break;
      if (cover.begin.x > at) length += cover.begin.x - at;
      at = std::max(at, cover.end.x);
    }
    if (at < span.end.x) length += span.end.x - at;
  }
  return length;
}

// Returns the length of those edges of the covers at which an uncovered part of the spans ends. The spans must be disjoint.
double edge_without(const Spans &spans, std::vector<Interval<End>> covers) {
  // Covers of folded leaflets may begin or end in the same point. Their order decides which edge is measured, so covers are
  // compared by all their members.
  std::sort(covers.begin(), covers.end(), [](const Interval<End> &a, const Interval<End> &b) {
    return std::tie(a.begin.x, a.end.x, a.begin.along, a.end.along) <
           std::tie(b.begin.x, b.end.x, b.begin.along, b.end.along);
  });
  double edge = 0;
  for (const Interval<Place> &span : spans) {
    End at{span.begin.x, 0};
    for (const Interval<End> &cover : covers) {
      if (cover.begin.x >= span.end.x) break;
      if (cover.begin.x > at.x) edge += at.along + cover.begin.along;
      if (cover.end.x > at.x) at = cover.end;
    }
    if (at.x < span.end.x) edge += at.along;
  }
  return edge;
}

// Measures the edge by lines along x.
double uncovered_edge_along_x(const Outline &outline, const Cover &cover, double reach, std::int64_t n_lines,
                              bool counts_equal) {
  const ScanLines lines(outline, n_lines);
  const SpansOfLines insides = inside(outline, lines);
  Covered<End> covered(lines, counts_equal);
  covered.add_triangles(cover);
  covered.add_rim(cover, reach);
  double edge = 0;
  for (std::size_t i = 0; i < insides.size(); ++i) edge += edge_without(insides[i], std::move(covered.intervals[i]));
  return edge * lines.spacing();
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

// Returns false if the enclosed area is only rounding error, as for lines that are seen edge on.
bool has_area(const Outline &outline, double rounding) {
  const double height = ScanLines(outline, 1).spacing(), width = ScanLines(swapped(outline), 1).spacing();
  const double size = std::max(height, width);
  return height > 0 && area_of(outline) > std::max(1e-9 * size, rounding) * size;
}

// Returns 1 or -1 for the side of the triangle that faces the viewer. Returns 0 if the triangle is seen edge on.
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
  // An edge, and its use by triangles. `sides` is the sum of side_of over the triangles that have this edge. If two triangles lie
  // on opposite sides of the edge, the sum is 2 or -2.
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
      use.n = -1;  // so that the edge's second triangle does not add it again
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

UncoveredAreas uncovered_areas(const Outline &outline, const Cover &cover, double reach, std::int64_t n_lines) {
  const ScanLines lines(outline, n_lines);
  const SpansOfLines insides = inside(outline, lines);
  Covered<Place> covered(lines, true);
  const auto measured = [&] {
    double length = 0;
    for (std::size_t i = 0; i < insides.size(); ++i) {
      join(covered.intervals[i]);
      length += length_without(insides[i], covered.intervals[i]);
    }
    return length * lines.spacing();
  };
  covered.add_triangles(cover);
  UncoveredAreas areas{measured(), 0};
  covered.add_rim(cover, reach);
  areas.beyond_reach = reach > 0 ? measured() : areas.outside;
  return areas;
}

double uncovered_edge(const Outline &outline, const Cover &cover, double reach, std::int64_t n_lines) {
  return uncovered_edge_along_x(outline, cover, reach, n_lines, true) +
         uncovered_edge_along_x(swapped(outline), swapped(cover), reach, n_lines, false);
}

}  // namespace riis
