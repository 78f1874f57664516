// SPDX-License-Identifier: Apache-2.0
#include "surface/grids.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "api/errors.hpp"
#include "surface/triangle_set.hpp"

namespace riis {
namespace {

// How the allowed error is shared out; docs/theory.md, "Tolerance". A point of a Coons patch inherits the errors of a u and of
// a v curve and of merged grid lines, each bounded as below; what they leave in a quad is for its split into triangles:
// at least 1 - 2 * (curve_share + merge_share).
constexpr double curve_share = 0.45, merge_share = 0.01;
// A point of a patch of arcs inherits the mean of two curves' errors, at most half of O's, and that of the chords of arcs: at
// least 1 - (arc_curve_share + merge_share + offset_share / 2 + row_share) is left.
constexpr double arc_curve_share = 0.4, offset_share = 0.2, row_share = 0.45;

class GridMaker {
 public:
  GridMaker(const PatchSet &set, double max_error) : set_(set), max_error_(max_error) { make_polylines(); }

  std::vector<QuadGrid> make() {
    for (const Patch &patch : set_.patches) sides_.push_back(sides_of(patch));
    for (std::size_t i = 0; i < sides_.size(); ++i)
      lines_.push_back(set_.patches[i].bulge != 0 ? arc_lines(i) : ArcLines{});
    // Patches of arcs meet along arcs: all have the same number of rows.
    double offset = 0;
    for (const ArcLines &lines : lines_) offset = std::max(offset, lines.largest_offset());
    const double n_rows = std::ceil(std::sqrt(0.5 * offset / (row_share * max_error_)));
    check_count(n_at_least(n_rows), max_error_);
    check_precision();
    std::vector<QuadGrid> grids;
    for (std::size_t i = 0; i < sides_.size(); ++i)
      grids.push_back(set_.patches[i].bulge != 0
                          ? make_arc_grid(sides_[i], lines_[i], static_cast<std::size_t>(std::max(n_rows, 1.0)))
                          : make_quad_grid(sides_[i], merge_share * max_error_));
    return grids;
  }

 private:
  // One polyline a curve, as exact as the most demanding of its patches needs it.
  void make_polylines() {
    const double unused = std::numeric_limits<double>::infinity();
    std::vector<double> share(set_.curves.size(), unused);
    const auto use = [&](const Side &side, double of_patch) {
      share[side.curve] = std::min(share[side.curve], of_patch);
    };
    for (const Patch &patch : set_.patches) {
      for (const Side &side : {patch.v0, patch.v1}) use(side, patch.bulge != 0 ? arc_curve_share : curve_share);
      if (patch.bulge == 0)
        for (const Side &side : {patch.u0, patch.u1}) use(side, curve_share);
    }
    for (std::size_t i = 0; i < share.size(); ++i) {
      polylines_.push_back(share[i] < unused ? make_polyline(set_.curves[i], share[i] * max_error_) : Polyline{});
      reversed_.push_back(reversed(polylines_.back()));
    }
  }

  PatchSides sides_of(const Patch &patch) const {
    const auto polyline = [&](const Side &side) { return &(side.reversed ? reversed_ : polylines_)[side.curve]; };
    return {polyline(patch.v0), polyline(patch.v1), polyline(patch.u0), polyline(patch.u1)};
  }

  ArcLines arc_lines(std::size_t i) const {
    const Patch &patch = set_.patches[i];
    const auto curve = [&](const Side &side) {
      return side.reversed ? set_.curves[side.curve].reversed() : set_.curves[side.curve];
    };
    // What makes the side an arc, from its control points: both patches at it get the same bits.
    const auto offset = [&](const Side &side) {
      const auto &control = set_.curves[side.curve].pieces().front().control;
      return control[1] - 0.5 * (control[0] + control[2]);
    };
    return make_arc_lines(sides_[i], Bulge(curve(patch.v0), curve(patch.v1), patch.bulge), offset(patch.u0),
                          offset(patch.u1), merge_share * max_error_, offset_share * max_error_);
  }

  // Patches so far from the origin that their coordinates round by what matters cannot be right to max_error.
  void check_precision() const {
    double largest = 0;
    for (const Curve &curve : set_.curves)
      for (const Bezier &piece : curve.pieces())
        for (int k = 0; k <= piece.degree; ++k) {
          const Vec3 q = piece.control[static_cast<std::size_t>(k)];
          largest = std::max({largest, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
        }
    if (largest * std::numeric_limits<double>::epsilon() > 1e-3 * max_error_)
      fail(RIIS_LIMIT_EXCEEDED,
           "control points have coordinates up to %s, which round by more than a thousandth of tolerance * "
           "half_thickness "
           "before scaling, %s",
           Number(largest).text, Number(max_error_).text);
  }

  // Triangles if no quad is split.
  double n_at_least(double n_rows) const {
    double n = 0;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const auto n_between = [](const Polyline &a, const Polyline &b) {
        return static_cast<double>(std::max<std::size_t>({a.t.size(), b.t.size(), 2}) - 1);
      };
      const PatchSides &sides = sides_[i];
      const double n_quads = set_.patches[i].bulge != 0 ? n_rows * static_cast<double>(lines_[i].errors.size())
                                                        : n_between(*sides.side_v0, *sides.side_v1) *
                                                              n_between(*sides.side_u0, *sides.side_u1);
      n += 2 * n_quads * static_cast<double>(set_.patches[i].images.size());
    }
    return n;
  }

  const PatchSet &set_;
  double max_error_;
  std::vector<Polyline> polylines_, reversed_;
  std::vector<PatchSides> sides_;
  std::vector<ArcLines> lines_;
};

}  // namespace

std::vector<QuadGrid> make_grids(const PatchSet &set, double max_error) { return GridMaker(set, max_error).make(); }

void check_count(double n_triangles, double max_error) {
  if (!(n_triangles <= static_cast<double>(max_triangles)))
    fail(RIIS_LIMIT_EXCEEDED,
         "the surface needs more than %lld triangles, about %s, to be right to %s, which is tolerance * half_thickness "
         "before scaling",
         static_cast<long long>(max_triangles), Number(std::ceil(n_triangles)).text, Number(max_error).text);
}

}  // namespace riis
