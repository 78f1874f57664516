// SPDX-License-Identifier: Apache-2.0
#include "program/orifice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "common/array_view.hpp"

namespace riis::program {
namespace {

struct Span {
  double begin, end;
};

// The lines along x in the middle of equal strips of the outline.
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

// Calls visit(i, x) for each line that the edge meets. The edge's upper end does not count. Both directions give the same x, so
// that neighbours leave no gap.
template <class Visit>
void for_each_crossing(const ScanLines &lines, PlanePoint a, PlanePoint b, const Visit &visit) {
  if (b[1] < a[1]) std::swap(a, b);
  const std::int64_t end = lines.first_from(b[1]);
  for (std::int64_t i = lines.first_from(a[1]); i < end; ++i) visit(i, x_at(a, b, lines.y(i)));
}

using SpansOfLines = std::vector<std::vector<Span>>;

SpansOfLines circle_spans(const Outline &circle, const ScanLines &lines) {
  SpansOfLines spans(static_cast<std::size_t>(lines.n()));
  for (std::int64_t i = 0; i < lines.n(); ++i) {
    const double y = lines.y(i) - circle.centre[1];
    const double half = std::sqrt(std::max(0.0, (circle.radius - y) * (circle.radius + y)));
    view(spans)[i].push_back({circle.centre[0] - half, circle.centre[0] + half});
  }
  return spans;
}

SpansOfLines inside(const Outline &outline, const ScanLines &lines) {
  if (outline.radius > 0) return circle_spans(outline, lines);
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(lines.n()));
  for (const auto &[a, b] : outline.edges)
    for_each_crossing(lines, a, b, [&](std::int64_t i, double x) { view(crossings)[i].push_back(x); });
  SpansOfLines spans(crossings.size());
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    std::sort(crossings[i].begin(), crossings[i].end());
    for (std::size_t k = 1; k < crossings[i].size(); k += 2) spans[i].push_back({crossings[i][k - 1], crossings[i][k]});
  }
  return spans;
}

// A line meets a triangle in at most one span.
SpansOfLines covered(const std::vector<PlaneTriangle> &triangles, const ScanLines &lines) {
  SpansOfLines spans(static_cast<std::size_t>(lines.n()));
  std::vector<std::int64_t> of_triangle(spans.size(), -1);
  for (std::int64_t triangle = 0; triangle < view(triangles).size(); ++triangle) {
    const PlaneTriangle &corner = view(triangles)[triangle];
    for (std::size_t k = 0; k < 3; ++k)
      for_each_crossing(lines, corner[k], corner[(k + 1) % 3], [&](std::int64_t i, double x) {
        if (view(of_triangle)[i] != triangle) {
          view(of_triangle)[i] = triangle;
          view(spans)[i].push_back({x, x});
        } else {
          Span &span = view(spans)[i].back();
          span = {std::min(span.begin, x), std::max(span.end, x)};
        }
      });
  }
  return spans;
}

double total(const std::vector<Span> &spans) {
  double sum = 0;
  for (const Span &span : spans) sum += span.end - span.begin;
  return sum;
}

// Returns the length of the disjoint spans that the covers leave uncovered.
double length_without(const std::vector<Span> &spans, std::vector<Span> covers) {
  std::sort(covers.begin(), covers.end(), [](const Span &a, const Span &b) { return a.begin < b.begin; });
  double length = 0;
  for (const Span &span : spans) {
    double at = span.begin;
    for (const Span &cover : covers) {
      if (cover.begin >= span.end) break;
      if (cover.begin > at) length += cover.begin - at;
      at = std::max(at, cover.end);
    }
    if (at < span.end) length += span.end - at;
  }
  return length;
}

}  // namespace

namespace {

// Lines that are seen edge on enclose only an area by rounding.
bool has_area(const Outline &outline) {
  const double height = ScanLines(outline, 1).spacing();
  return height > 0 && area_of(outline) > 1e-9 * height * height;
}

}  // namespace

Outline circle(double radius, const PlanePoint &centre) { return {radius, centre, {}}; }

std::optional<Outline> closed_outline(const std::vector<Line> &lines) {
  Outline outline;
  std::map<PlanePoint, int> n_ends;
  for (const Line &line : lines) {
    for (std::size_t i = 1; i < line.size(); ++i)
      outline.edges.push_back({PlanePoint{line[i - 1][0], line[i - 1][1]}, PlanePoint{line[i][0], line[i][1]}});
    for (const Point &end : {line.front(), line.back()}) ++n_ends[{end[0], end[1]}];
  }
  const bool is_closed = std::all_of(n_ends.begin(), n_ends.end(), [](const auto &end) { return end.second % 2 == 0; });
  if (lines.empty() || !is_closed || !has_area(outline)) return std::nullopt;
  return outline;
}

std::vector<PlaneTriangle> projected(const riis_triangles &surface) {
  std::vector<PlaneTriangle> triangles(static_cast<std::size_t>(surface.n_triangles));
  for (std::int64_t i = 0; i < surface.n_triangles; ++i)
    for (std::int64_t k = 0; k < 3; ++k) {
      const Point p = vertex_of(surface, surface.vertex_id[3 * i + k]);
      view(view(triangles)[i])[k] = {p[0], p[1]};
    }
  return triangles;
}

double area_of(const Outline &outline, std::int64_t n_lines) {
  const ScanLines lines(outline, n_lines);
  double length = 0;
  for (const auto &spans : inside(outline, lines)) length += total(spans);
  return length * lines.spacing();
}

double uncovered_area(const Outline &outline, const std::vector<PlaneTriangle> &triangles, std::int64_t n_lines) {
  const ScanLines lines(outline, n_lines);
  const SpansOfLines insides = inside(outline, lines);
  SpansOfLines covers = covered(triangles, lines);
  double length = 0;
  for (std::size_t i = 0; i < insides.size(); ++i) length += length_without(insides[i], std::move(covers[i]));
  return length * lines.spacing();
}

}  // namespace riis::program
