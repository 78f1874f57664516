// SPDX-License-Identifier: Apache-2.0
// Turns patches into triangles (paper, 3.3 and 4.1 "Triangulation").
// The patches of a valve become placed triangles, each with its patch, leaflet, u and v.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/recycled.hpp"
#include "geometry/coons.hpp"
#include "geometry/placement.hpp"
#include "geometry/quads.hpp"
#include "motion/displacement.hpp"
#include "triangulate/triangle_set.hpp"
#include "valve/patches.hpp"

namespace riis {

// Grids whose lines stay the same while a valve opens (docs/theory/triangles.md, "Fixed triangulation"). A plan is made from the
// patches of a valve at many openings. The plan's lines keep the allowed error at all these openings. At any opening, grids can
// be made on these lines, and the errors of these grids are bounded.
struct PatchPlan {
  bool has_arcs = false;  // whether the patch is a patch of arcs at some opening

  GridLines lines;  // the lines of a Coons patch

  // A patch of arcs has lines in u, which move with the joints of its base. Stored are the lines and joints at one opening. At
  // every other opening, a line keeps its relative position between two joints. Without joints the lines do not move.
  Vector<double> u, joints;
  Vector<int> n_parts;  // the number of parts between two lines; O is evaluated at their ends
};

// The numbers by which the sides of patches refer to curves. At another opening, the curves may be numbered differently. For
// example, closed mitral leaflets share curves that open leaflets have separately.
class CurveNumbering {
 public:
  explicit CurveNumbering(const PatchSet &set);
  // Returns whether the patches already use this numbering.
  bool is_of(const PatchSet &set) const;
  // Returns the same patches with their curves numbered in this way. Lists with an entry for each curve then have the same
  // meaning at all openings. Apart from shared curves, the patches must be built alike (check_same_build).
  PatchSet renumbered(const PatchSet &set) const;

 private:
  Vector<Patch> patches_;
  std::size_t n_curves_;
};

struct GridPlan {
  Vector<Vector<double>> shares;  // shares of each curve's length at its vertices; empty if only arcs end on the curve
  Vector<PatchPlan> patches;
  std::size_t n_rows = 1;  // the number of rows of all patches of arcs
};

// Makes the plan. `states` has the patches at each of the openings. The patches of all openings must use one numbering of curves.
// A curve of a Coons patch has an error of at most max_error * of_curves, times the curve's tightness. The curves of other
// patches stay within a share of their own. Fails with RIIS_LIMIT_EXCEEDED for more than max_triangles, and with
// RIIS_INVALID_PARAMETER if no number of lines is enough.
GridPlan plan_grids(const Vector<PatchSet> &states, double max_error, double of_curves,
                    const Vector<double> &tightness);

// Makes one grid for each patch on the plan's lines. (The make_grids of triangulate/grids.hpp chooses its own lines.) The
// function refines the bounds of errors only as far as max_error requires.
Vector<QuadGrid> make_grids(const PatchSet &set, const GridPlan &plan, double max_error, int n_threads,
                            bool keeps_lines);

// A triangle without area, which is one half of a quad. `a` and `b` are the ends of the quad's diagonal, and `corner` is the
// third vertex.
struct LeftOut {
  std::int64_t corner, a, b;
  bool other_was_kept;
};

// The triangles of a plan at one of the openings, as ids of the plan's vertices. These triangles serve all openings at which the
// same triangles have an area.
struct Connectivity {
  std::vector<std::int64_t> vertex_id, triangle_id;
  std::vector<std::int32_t> leaflet_id, patch_id;
  Grouping grouping;
  Vector<LeftOut> left_out;
  // An image of a patch: the position after its last triangle, and whether the previous image has the same triangles.
  struct OfImage {
    std::int64_t end;
    bool is_as_before;
  };
  Vector<OfImage> images;
  std::uint64_t number = 0;  // the plan's number
};

// A triangulation that stays the same while a valve opens: grids, levels of the quads' subdivision, and triangles.
struct TriangulationPlan {
  GridPlan grids;
  CurveNumbering curves;       // the numbering that the grids use
  double max_error;            // the error for which the lines and levels were chosen
  Vector<Vector<int>> levels;  // levels of the quads of each patch
  Connectivity connectivity;
};

// Makes the plan from a valve's patches at many openings. `asked_error` is the max_error of a Triangulation. The plan uses a
// little less than this error, and thus also serves openings between the given openings. Fails as triangulate_fixed does.
TriangulationPlan plan_triangulation(const Vector<PatchSet> &given, double asked_error, int n_threads);

// Returns whether, in a state, the plan's triangles are within asked_error of the smooth surface.
bool is_within(const PatchSet &state, const TriangulationPlan &plan, double asked_error);

struct Triangulation {
  double
      max_error;  // bounds the distance between triangles and smooth surface, in the patches' units (before placement)
  const Placement &placement;
  bool flip_normals;
  int n_threads;
  const EarlierState *earlier = nullptr;  // null without velocities; the bits of the triangles do not depend on it
};

// Makes triangles on grids as coarse as the state allows. `memory` is a set whose memory the function reuses. Fails with
// RIIS_LIMIT_EXCEEDED for more than max_triangles, and with RIIS_INVALID_PARAMETER for a patch without area.
TriangleSet triangulate_adapted(const PatchSet &set, const Triangulation &asked, TriangleSet memory = {});
// Makes the triangles of a plan. A triangle keeps its id even if other triangles lose their area. Fails as triangulate_adapted
// does. Also fails with RIIS_LIMIT_EXCEEDED if the plan's error in this state exceeds max_error.
TriangleSet triangulate_fixed(const PatchSet &set, const Triangulation &asked, const TriangulationPlan &plan,
                              TriangleSet memory = {});

}  // namespace riis
