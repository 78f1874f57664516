// SPDX-License-Identifier: Apache-2.0
// Turns patches into triangles (paper, 3.3 and 4.1 "Triangulation").
// In: curves and patches of a valve, the allowed error, the placement. Out: triangles with their patch, leaflet, u and v.
#pragma once

#include <cstdint>
#include <vector>

#include "base/recycled.hpp"
#include "geometry/placement.hpp"
#include "geometry/quads.hpp"
#include "motion/displacement.hpp"
#include "triangulate/grid_plan.hpp"
#include "triangulate/triangle_set.hpp"
#include "valve/patches.hpp"

namespace riis {

// A triangle without area, which is one half of a quad. `a` and `b` are the ends of the quad's diagonal, and `corner` is the
// third vertex.
struct LeftOut {
  std::int64_t corner, a, b;
  bool other_was_kept;
};

// The triangles of a plan at one of the openings, as ids of the plan's vertices. Two openings share them if the same triangles
// have area.
struct Connectivity {
  std::vector<std::int64_t> vertex_id, triangle_id;
  std::vector<std::int32_t> leaflet_id, patch_id;
  Grouping grouping;
  Vector<LeftOut> left_out;
  // For each image of each patch: the end of its triangles, and whether its triangles are the same as those of the previous
  // image.
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
  double max_error;            // the error that the lines and levels were chosen for
  Vector<Vector<int>> levels;  // levels of the quads of each patch
  Connectivity connectivity;
};

// Makes the plan from a valve's patches at many openings. asked_error is the max_error of a Triangulation. The plan uses a little
// less than this error, so that it also serves openings between the given ones. Fails as triangulate_fixed does.
TriangulationPlan plan_triangulation(const Vector<PatchSet> &given, double asked_error, int n_threads);

// Returns whether the plan's triangles are within asked_error of the smooth surface in a state.
bool is_within(const PatchSet &state, const TriangulationPlan &plan, double asked_error);

struct Triangulation {
  double
      max_error;  // bounds the distance between triangles and smooth surface, in the patches' units (before placement)
  const Placement &placement;
  bool flip_normals;
  int n_threads;
  const EarlierState *earlier = nullptr;  // null without velocities; it never changes the triangles' bits
};

// Makes triangles on grids as coarse as the state allows. `memory` is a set whose memory is reused. Fails with
// RIIS_LIMIT_EXCEEDED for more than max_triangles, and with RIIS_INVALID_PARAMETER for a patch without area.
TriangleSet triangulate_adapted(const PatchSet &set, const Triangulation &asked, TriangleSet memory = {});
// Makes the triangles of a plan. A triangle keeps its id if other triangles lose their area. Fails as triangulate_adapted does,
// and with RIIS_LIMIT_EXCEEDED if the plan is not within max_error of this state.
TriangleSet triangulate_fixed(const PatchSet &set, const Triangulation &asked, const TriangulationPlan &plan,
                              TriangleSet memory = {});

}  // namespace riis
