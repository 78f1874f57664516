// SPDX-License-Identifier: Apache-2.0
// Turns patches into triangles (paper, 3.3 and 4.1 "Triangulation").
// In: curves and patches of a valve, the allowed error, the placement. Out: triangles with their patch, leaflet, u and v.
#pragma once

#include <cstdint>
#include <vector>

#include "base/recycled.hpp"
#include "geometry/placement.hpp"
#include "surface/displacement.hpp"
#include "surface/grid_plan.hpp"
#include "surface/quads.hpp"
#include "surface/triangle_set.hpp"
#include "valve/patches.hpp"

namespace riis {

// A half of a quad without area, by its vertices: a and b are the ends of the quad's diagonal.
struct LeftOut {
  std::int64_t corner, a, b;
  bool other_was_kept;
};

// The triangles of a plan at one of the openings, for a set of its vertices. Two openings share them if the same triangles
// have area.
struct Connectivity {
  std::vector<std::int64_t> vertex_id, triangle_id;
  std::vector<std::int32_t> leaflet_id, patch_id;
  Grouping grouping;
  Vector<LeftOut> left_out;
  // For each image of each patch: the end of its triangles, and whether they are those of the image before.
  struct OfImage {
    std::int64_t end;
    bool is_as_before;
  };
  Vector<OfImage> images;
  std::uint64_t number = 0;  // of the plan
};

// A triangulation that stays the same while a valve opens: its grids, its quads' levels of subdivision, its triangles.
struct TriangulationPlan {
  GridPlan grids;
  CurveNumbering curves;       // of the grids
  double max_error;            // that the lines and levels were chosen for
  Vector<Vector<int>> levels;  // of each patch's quads
  Connectivity connectivity;
};

// Makes the plan for a valve's patches at many openings. asked_error is the max_error of a Triangulation; the plan keeps a small
// part of it for openings between these. Fails as triangulate_fixed does.
TriangulationPlan plan_triangulation(const Vector<PatchSet> &given, double asked_error, int n_threads);

// Returns whether the plan's triangles are within asked_error of a state.
bool is_within(const PatchSet &state, const TriangulationPlan &plan, double asked_error);

struct Triangulation {
  double
      max_error;  // bounds the distance between triangles and smooth surface, in the patches' units (before placement)
  const Placement &placement;
  bool flip_normals;
  int n_threads;
  const Motion *motion = nullptr;  // gives the vertices velocities; the triangles are the same, bit for bit
};

// Makes triangles on grids as coarse as the state allows, in the memory of triangles that are no longer wanted. Fails with
// RIIS_LIMIT_EXCEEDED for more than max_triangles, and with RIIS_INVALID_PARAMETER for a patch without area.
TriangleSet triangulate_adapted(const PatchSet &set, const Triangulation &asked, TriangleSet memory = {});
// Does the same by a plan: triangles keep their ids if others lose their area. Also fails with RIIS_LIMIT_EXCEEDED if the plan is
// not within max_error of this state.
TriangleSet triangulate_fixed(const PatchSet &set, const Triangulation &asked, const TriangulationPlan &plan,
                              TriangleSet memory = {});

}  // namespace riis
