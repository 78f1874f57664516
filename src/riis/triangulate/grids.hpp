// SPDX-License-Identifier: Apache-2.0
// Turns patches into grids of quads (paper, 3.2 and 3.3).
// Each patch of a valve becomes one grid. The grid's error leaves room for the error of the split into triangles.
#pragma once

#include "base/recycled.hpp"
#include "geometry/coons.hpp"
#include "geometry/quads.hpp"
#include "valve/patches.hpp"

namespace riis {

// The allowed error is divided among these errors as in docs/theory/triangles.md, "Shares of the bound". A point of a Coons patch
// has three errors, which come from a u curve, from a v curve, and from merging grid lines. The shares below bound the three
// errors. At least 1 - 2 * (curve_share + merge_share) remains for the split of a quad into triangles.
inline constexpr double curve_share = 0.45, merge_share = 0.01;
// With the lines of a plan, the error from a curve is nearly everywhere the share `planned_curve_share` of the allowed error. A
// larger share would leave so little for the quads that many of them would be subdivided.
inline constexpr double planned_curve_share = 0.39;
// A point of a patch of arcs has three errors: the mean of both curves' errors, at most half the error of O, and the error of the
// arcs' chords. At least 1 - (arc_curve_share + merge_share + offset_share / 2 + row_share) remains.
inline constexpr double arc_curve_share = 0.4, offset_share = 0.2, row_share = 0.45;

// Between two vertices of a curve, the velocity is nearly linear. The estimated deviation is at most `bend_share` of the largest
// speed.
inline constexpr double bend_share = 0.008;

// Returns the number of rows that keeps chords within their share of max_error, for arcs with offsets up to `offset`.
double rows_for(double offset, double max_error);

// Makes one grid for each patch, in the order of the patches, before any image is placed. The error of each curve stays below the
// share of max_error that is reserved for curves. Fails with RIIS_LIMIT_EXCEEDED if the surface would take more than
// max_triangles triangles.
Vector<QuadGrid> make_grids(const PatchSet &set, double max_error);
// Makes the same grids as make_grids, but keeps each grid's lines, and gives each quad its level. The allowed error of a curve is
// multiplied by the curve's tightness. An empty `tightness` means 1 for all curves.
Vector<LevelledGrid> make_levelled_grids(const PatchSet &set, double max_error, const Vector<double> &tightness,
                                         int n_threads);

// Checks the precision of a set. Fails with RIIS_LIMIT_EXCEEDED if the curves' lengths or coordinates are rounded too coarsely
// for max_error.
void check_precision(const PatchSet &set, double max_error);

// The curves deviate from the shape that they represent. Returns max_error minus this deviation. Fails with RIIS_LIMIT_EXCEEDED
// if the deviation is more than half of max_error.
double error_left(const PatchSet &set, double max_error);

// Fails with RIIS_LIMIT_EXCEEDED if n_triangles is more than max_triangles.
void check_count(double n_triangles, double max_error);

}  // namespace riis
