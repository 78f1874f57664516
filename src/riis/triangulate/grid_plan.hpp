// SPDX-License-Identifier: Apache-2.0
// Grids whose lines stay the same while a valve opens (docs/theory.md, "Fixed triangulation").
// In: the patches of a valve at many openings, the allowed error. Out: lines that keep the error at all these openings. Also
// grids on these lines at any opening, with their errors.
#pragma once

#include <cstddef>

#include "base/recycled.hpp"
#include "geometry/coons.hpp"
#include "valve/patches.hpp"

namespace riis {

struct PatchPlan {
  bool has_arcs = false;  // whether the patch is one of arcs at some opening

  GridLines lines;  // the lines of a Coons patch

  // A patch of arcs has lines in u, and joints of the base that the lines move with. Both are given at one of the openings.
  // Between two joints, a line keeps its relative position. Without joints the lines do not move.
  Vector<double> u, joints;
  Vector<int> n_parts;  // the number of parts between two lines; O is evaluated at the ends of the parts
};

// The numbering of curves that the sides of patches use. A set of patches may number its curves differently at each opening. For
// example, closed mitral leaflets share curves that are separate in open leaflets.
class CurveNumbering {
 public:
  explicit CurveNumbering(const PatchSet &set);
  // Returns whether the patches already use this numbering.
  bool is_of(const PatchSet &set) const;
  // Returns the patches with this numbering of curves. Then lists with an entry for each curve fit all openings. The patches
  // must have the same build except for shared curves (check_same_build).
  PatchSet renumbered(const PatchSet &set) const;

 private:
  Vector<Patch> patches_;
  std::size_t n_curves_;
};

struct GridPlan {
  Vector<Vector<double>> shares;  // shares of each curve's length at its vertices; empty if only arcs end on it
  Vector<PatchPlan> patches;
  std::size_t n_rows = 1;  // the number of rows of all patches of arcs
};

// Makes the plan from the patches at each of the openings. All must use one numbering of curves. Keeps each curve of a Coons
// patch within max_error times of_curves times its tightness, and the curves of other patches within their own share. Fails with
// RIIS_LIMIT_EXCEEDED for more than max_triangles, and with RIIS_INVALID_PARAMETER if no lines are enough.
GridPlan plan_grids(const Vector<PatchSet> &states, double max_error, double of_curves,
                    const Vector<double> &tightness);

// Makes one grid for each patch on the plan's lines. (The other make_grids chooses its own lines.) The bounds of errors are
// refined no further than max_error requires.
Vector<QuadGrid> make_grids(const PatchSet &set, const GridPlan &plan, double max_error, int n_threads,
                            bool keeps_lines);

}  // namespace riis
