// SPDX-License-Identifier: Apache-2.0
// Turns patches into grids of quads (paper, 3.2 and 3.3).
// In: curves and patches of a valve, the allowed error. Out: a grid for each patch, which leaves enough of that error
// for the split of quads into triangles.
#pragma once

#include "base/recycled.hpp"
#include "geometry/coons.hpp"
#include "valve/patches.hpp"

namespace riis {

// The allowed error is shared out as in docs/theory.md, "Tolerance". A point of a Coons patch inherits the errors of a
// u curve, a v curve and merged grid lines, each bounded as below. At least 1 - 2 * (curve_share + merge_share) is left
// for the split of a quad into triangles.
inline constexpr double curve_share = 0.45, merge_share = 0.01;
// A plan's lines use their share nearly everywhere. A larger share would leave too little for quads, and many would be split
// further.
inline constexpr double planned_curve_share = 0.39;
// The error of a point of a patch of arcs has three parts: the mean of two curves' errors, at most half of the error of O, and
// the error of the arcs' chords. At least 1 - (arc_curve_share + merge_share + offset_share / 2 + row_share) is left.
inline constexpr double arc_curve_share = 0.4, offset_share = 0.2, row_share = 0.45;

// The velocity between two vertices of a curve is estimated to be off linear by at most this share of the largest speed.
inline constexpr double bend_share = 0.008;

// Returns the rows that keep the chords of arcs with offsets up to `offset` within their share of max_error.
double rows_for(double offset, double max_error);

// Makes one grid for each patch, in their order, before any image of the patch is placed. Keeps each curve within its
// share of max_error times its tightness; an empty `tightness` means 1 for all. Grids keep their lines if `keeps_lines` is
// true. Fails with RIIS_LIMIT_EXCEEDED if the surface would take more than max_triangles triangles.
Vector<QuadGrid> make_grids(const PatchSet &set, double max_error, const Vector<double> &tightness = {},
                            int n_threads = 1, bool keeps_lines = false);

// Fails with RIIS_LIMIT_EXCEEDED if lengths or coordinates of curves round by too much for max_error.
void check_precision(const PatchSet &set, double max_error);

// Returns max_error minus the deviation of the curves from the shape that they stand for. Fails with RIIS_LIMIT_EXCEEDED if the
// deviation takes more than half of it.
double error_left(const PatchSet &set, double max_error);

// Fails with RIIS_LIMIT_EXCEEDED for more than max_triangles.
void check_count(double n_triangles, double max_error);

}  // namespace riis
