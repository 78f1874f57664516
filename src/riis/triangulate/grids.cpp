// SPDX-License-Identifier: Apache-2.0
#include "triangulate/grids.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"
#include "triangulate/triangle_set.hpp"

namespace riis {
namespace {

// Returns the largest speed of any curve. A speed is a motion per unit of opening, at one of five points of each span. Five
// points are enough to notice any motion, because a cubic that is 0 at all five points is 0 everywhere.
double largest_rate(const PatchSet &set) {
  double largest = 0;
  for (const Vector<Bezier> &rates : set.rates)
    for (const Bezier &rate : rates)
      for (int i = 0; i <= 4; ++i) largest = std::max(largest, length(evaluate(rate, 0.25 * i)));
  return largest;
}

class GridMaker {
 public:
  GridMaker(const PatchSet &set, double max_error, const Vector<double> &tightness, int n_threads, bool keeps_lines)
      : set_(set),
        keeps_lines_(keeps_lines),
        max_error_(max_error),
        max_bend_(bend_share * largest_rate(set)),
        n_threads_(n_threads),
        errors_(set.curves.size(), infinity),
        polylines_(set.curves.size()),
        reversed_(set.curves.size()),
        is_reversed_(set.curves.size(), 0) {
    check_precision(set, max_error);
    // The polyline of each curve is as exact as the most demanding of its patches requires.
    for (const Patch &patch : set.patches) {
      for (const Side &side : {patch.v0, patch.v1}) allow(side, patch.bulge != 0 ? arc_curve_share : curve_share);
      if (patch.bulge == 0)
        for (const Side &side : {patch.u0, patch.u1}) allow(side, curve_share);
    }
    for (std::size_t i = 0; i < tightness.size(); ++i) errors_[i] *= tightness[i];
  }

  // Makes the grids, and passes each grid to `finish` on the thread that made it. After each step, counts the triangles before
  // large arrays are allocated.
  template <class Made, class Finish>
  Vector<Made> make(const Finish &finish) {
    const std::size_t n_patches = set_.patches.size();
    lines_.resize(n_patches);
    double n_at_least = 0;
    for (std::size_t first = 0; first < n_patches; first += patches_at_once) {
      const std::size_t end = std::min(first + patches_at_once, n_patches);
      make_polylines(first, end);
      const auto is_of_arcs = [&](std::size_t i) { return set_.patches[i].bulge != 0; };
      bool has_arcs = false;
      for (std::size_t i = first; i < end; ++i) has_arcs = has_arcs || is_of_arcs(i);
      if (has_arcs)
        for_each_patch(first, end, [&](std::size_t i) {
          if (is_of_arcs(i)) lines_[i] = arc_lines(set_.patches[i], sides_[i]);
        });
      for (std::size_t i = first; i < end; ++i) check_count(n_at_least += n_triangles(i, 1), max_error_);
    }
    // Two patches of arcs may share an arc, and each patch divides this arc into its rows. All patches of arcs therefore have the
    // same number of rows.
    double offset = 0;
    for (const ArcLines &lines : lines_) offset = std::max(offset, lines.largest_offset());
    const double n_rows = rows_for(offset, max_error_);
    double n = 0;
    for (std::size_t i = 0; i < n_patches; ++i) n += n_triangles(i, n_rows);
    check_count(n, max_error_);
    Vector<Made> made(n_patches);
    for_each_patch(0, n_patches, [&](std::size_t i) { made[i] = finish(grid(i, static_cast<std::size_t>(n_rows))); });
    return made;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  // A curve may have a million points, and a valve a million patches. The polylines are therefore made for `patches_at_once`
  // patches at a time, and then their points are counted. `patches_at_once` is fixed, so that the count in an error message does
  // not depend on the number of threads.
  static constexpr std::size_t patches_at_once = 16;

  QuadGrid grid(std::size_t i, std::size_t n_rows) const {
    const bool is_arcs = set_.patches[i].bulge != 0;
    GridLines lines;
    QuadGrid made = is_arcs ? make_arc_grid(sides_[i], lines_[i], n_rows)
                            : make_quad_grid(sides_[i], merge_share * max_error_, keeps_lines_ ? &lines : nullptr);
    if (keeps_lines_) made.lines = is_arcs ? lines_of_arc_grid(lines_[i], made) : std::move(lines);
    return made;
  }

  void allow(const Side &side, double share) {
    errors_[side.curve] = std::min(errors_[side.curve], share * max_error_);
    if (side.reversed) is_reversed_[side.curve] = 1;
  }

  template <class Visit>
  void for_each_patch(std::size_t first, std::size_t end, const Visit &visit) const {
    parallel_for(static_cast<std::int64_t>(end - first), n_threads_,
                 [&](std::int64_t i, int) { visit(first + static_cast<std::size_t>(i)); });
  }

  // Makes the polylines that these patches need and that do not exist yet.
  void make_polylines(std::size_t first, std::size_t end) {
    Vector<std::size_t> curves;
    for (std::size_t i = first; i < end; ++i) {
      const Patch &patch = set_.patches[i];
      for (const Side &side : {patch.v0, patch.v1, patch.u0, patch.u1})
        if (errors_[side.curve] != infinity && polylines_[side.curve].points.empty()) curves.push_back(side.curve);
    }
    std::sort(curves.begin(), curves.end());
    curves.erase(std::unique(curves.begin(), curves.end()), curves.end());
    parallel_for(view(curves).size(), n_threads_, [&](std::int64_t i, int) {
      const std::size_t at = view(curves)[i];
      polylines_[at] = max_bend_ > 0 && at < set_.rates.size()
                           ? make_polyline(set_.curves[at], errors_[at], set_.rates[at], max_bend_)
                           : make_polyline(set_.curves[at], errors_[at]);
      if (is_reversed_[at]) reversed_[at] = reversed(polylines_[at]);
    });
    for (std::size_t i = first; i < end; ++i) sides_.push_back(sides_of(set_.patches[i]));
  }

  const Polyline *polyline(const Side &side) const {
    return side.reversed ? &reversed_[side.curve] : &polylines_[side.curve];
  }

  PatchSides sides_of(const Patch &patch) const {
    // The sides u0 and u1 of a patch of arcs have no polylines, because they are divided into rows like all its arcs.
    const bool is_coons = patch.bulge == 0;
    return {polyline(patch.v0), polyline(patch.v1), is_coons ? polyline(patch.u0) : nullptr,
            is_coons ? polyline(patch.u1) : nullptr};
  }

  ArcLines arc_lines(const Patch &patch, const PatchSides &sides) const {
    const Vec3 at_u0 = arc_offset(set_, patch.u0), at_u1 = arc_offset(set_, patch.u1);
    // A patch with more lines than this limit would have too many triangles.
    const double n_rows = rows_for(std::max(length(at_u0), length(at_u1)), max_error_);
    const auto max_lines = static_cast<std::size_t>(static_cast<double>(max_triangles) / n_rows) + 2;
    ArcLines lines = make_arc_lines(sides, Bulge(along(set_, patch.v0), along(set_, patch.v1), patch.bulge), at_u0,
                                    at_u1, {merge_share * max_error_, offset_share * max_error_, max_lines});
    if (lines.u_lines.size() > max_lines) check_count(2 * n_rows * static_cast<double>(max_lines), max_error_);
    return lines;
  }

  // Returns the number of triangles in all images of a patch, if no quad is subdivided.
  double n_triangles(std::size_t i, double n_rows) const {
    const auto n_between = [](const Polyline &a, const Polyline &b) {
      return static_cast<double>(std::max<std::size_t>({a.t.size(), b.t.size(), 2}) - 1);
    };
    const PatchSides &sides = sides_[i];
    const double n_quads = set_.patches[i].bulge != 0
                               ? n_rows * static_cast<double>(lines_[i].errors.size())
                               : n_between(*sides.side_v0, *sides.side_v1) * n_between(*sides.side_u0, *sides.side_u1);
    return 2 * n_quads * static_cast<double>(set_.patches[i].images.size());
  }

  const PatchSet &set_;
  bool keeps_lines_;
  double max_error_;
  double max_bend_;  // allowed error of the velocity between two vertices of a curve; 0 if the valve does not open
  int n_threads_;
  Vector<double> errors_;  // allowed error of each curve; infinity if it needs no polyline
  Vector<Polyline> polylines_, reversed_;
  Vector<char> is_reversed_;  // 1 for each curve that a patch uses in the opposite direction
  Vector<PatchSides> sides_;
  Vector<ArcLines> lines_;
};

}  // namespace

Vector<QuadGrid> make_grids(const PatchSet &set, double max_error) {
  return GridMaker(set, max_error, {}, 1, false).make<QuadGrid>([](QuadGrid grid) { return grid; });
}

Vector<LevelledGrid> make_levelled_grids(const PatchSet &set, double max_error, const Vector<double> &tightness,
                                         int n_threads) {
  return GridMaker(set, max_error, tightness, n_threads, true).make<LevelledGrid>([max_error](QuadGrid grid) {
    return with_levels(std::move(grid), max_error);
  });
}

void check_precision(const PatchSet &set, double max_error) {
  double largest = 0, longest = 0;
  for (const Curve &curve : set.curves) {
    longest = std::max(longest, curve.length());
    for (const Bezier &span : curve.spans())
      for (int k = 0; k <= span.degree; ++k) {
        const Vec3 q = view(span.control)[k];
        largest = std::max({largest, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
      }
  }
  if (largest * std::numeric_limits<double>::epsilon() > 1e-3 * max_error)
    fail(RIIS_LIMIT_EXCEEDED, "control points have coordinates up to ", largest,
         "; their rounding exceeds a thousandth of tolerance * half_thickness in the valve's own units, which is ",
         max_error);
  if (longest * 1e-12 > 1e-2 * max_error)
    fail(
        RIIS_LIMIT_EXCEEDED, "a curve is ", longest,
        " long; the rounding of its length exceeds a hundredth of tolerance * half_thickness in the valve's own units, "
        "which is ",
        max_error);
}

double error_left(const PatchSet &set, double max_error) {
  if (!(set.deviation <= 0.5 * max_error))
    fail(RIIS_LIMIT_EXCEEDED, "the valve's curves are accurate to ", set.deviation,
         ", which is more than half of tolerance * half_thickness in the valve's own units, ", max_error);
  return max_error - set.deviation;
}

double rows_for(double offset, double max_error) {
  return std::max(1.0, std::ceil(std::sqrt(0.5 * offset / (row_share * max_error))));
}

void check_count(double n_triangles, double max_error) {
  if (!(n_triangles <= static_cast<double>(max_triangles)))
    fail(RIIS_LIMIT_EXCEEDED, "the surface needs more than ", max_triangles, " triangles, about ",
         std::ceil(n_triangles), ", to be accurate to ", max_error,
         ", which is tolerance * half_thickness before scaling");
}

}  // namespace riis
