// SPDX-License-Identifier: Apache-2.0
// Grids whose lines stay the same while a valve opens (docs/theory.md, "Fixed triangulation").
// In: the patches of a valve at many openings, the allowed error. Out: lines that keep the error at all of them; grids
// on these lines at any opening, with the error that they have there.
#pragma once

#include <cstddef>

#include "base/recycled.hpp"
#include "geometry/coons.hpp"
#include "valve/patches.hpp"

namespace riis {

struct PatchPlan {
  bool has_arcs = false;  // at any of the openings

  GridLines lines;  // of a Coons patch

  // A patch of arcs has the lines in u and the joints of the base that they move with, both at one of the openings. Between two
  // joints a line keeps its share of the way. Without joints the lines stay.
  Vector<double> u, joints;
  Vector<int> n_parts;  // between each two lines: the parts that O is evaluated between, to bound its error
};

// The numbers that the sides of patches give their curves. A valve may share curves at one opening and not at another, as
// closed mitral leaflets do.
class CurveNumbering {
 public:
  explicit CurveNumbering(const PatchSet &set);
  // Returns whether the patches already number their curves in this way.
  bool is_of(const PatchSet &set) const;
  // Returns the patches with curves numbered in this way. Lists by curve then fit all openings. The patches have the same build
  // but for shared curves (check_same_build).
  PatchSet renumbered(const PatchSet &set) const;

 private:
  Vector<Patch> patches_;
  std::size_t n_curves_;
};

struct GridPlan {
  Vector<Vector<double>> shares;  // of each curve's length, at its vertices; empty if only arcs end there
  Vector<PatchPlan> patches;
  std::size_t n_rows = 1;  // of patches of arcs
};

// Makes the plan for patches at each of the openings, all with one numbering of curves. Keeps each curve of a Coons patch
// within max_error times of_curves times its tightness, and curves of other patches within their share. Fails with
// RIIS_LIMIT_EXCEEDED for more than max_triangles, and with RIIS_INVALID_PARAMETER if no lines are enough.
GridPlan plan_grids(const Vector<PatchSet> &states, double max_error, double of_curves,
                    const Vector<double> &tightness);

// Makes one grid for each patch on the plan's lines, as the other make_grids does on its own lines. Bounds errors no
// closer than max_error needs.
Vector<QuadGrid> make_grids(const PatchSet &set, const GridPlan &plan, double max_error, int n_threads,
                            bool keeps_lines);

}  // namespace riis
