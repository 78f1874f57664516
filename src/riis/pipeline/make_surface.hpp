// SPDX-License-Identifier: Apache-2.0
// The pipeline turns a valve's parameters or the caller's arrays into a surface that answers queries for closest points. It also
// measures how many seconds its stages take.
#pragma once

#include <riis/riis.h>

#include <cstdint>

#include "arrays/user_arrays.hpp"
#include "geometry/placement.hpp"
#include "scene/surface.hpp"
#include "triangulate/triangulate.hpp"
#include "valve/valve.hpp"

namespace riis {

// A triangulation that stays the same while a valve opens and closes (docs/theory/triangles.md, "Fixed triangulation"). The plan
// of its triangles is the same for all openings of the valve.
class FixedTriangulation {
 public:
  // Makes the plan. `max_error` is the largest allowed distance between the triangles and the smooth surface, before placement.
  // Fails as the stages of the pipeline do, with a message that names the opening.
  FixedTriangulation(const Valve &valve, double max_error, int n_threads);

  // Fails with RIIS_INVALID_PARAMETER if the valve is not the valve of the plan. Only the opening and the values of the warp may
  // differ.
  void check(const Valve &valve) const { valve_.check_same_but_for_opening(valve); }
  const TriangulationPlan &plan() const { return plan_; }

 private:
  Valve valve_;
  TriangulationPlan plan_;
};

// The values that are needed to make any surface. Lengths are in mesh units.
struct SurfaceRequest {
  Band band;
  Placement placement;
  bool flip_normals;
  int n_threads;
};

// The allowed difference between distances to a generated valve and to the smooth valve, in mesh units.
struct ValveAccuracy {
  double triangle_error;
  std::int32_t measure;   // RIIS_MEASURE_*
  double distance_error;  // unused if triangles measure distances
  bool is_fixed;          // RIIS_TRIANGULATION_FIXED; otherwise triangles are as large as the present opening allows
};

// An earlier state of a valve, from which the surface gets its velocity.
struct EarlierValve {
  const Valve &before;
  Placement placement_before;
  double seconds;                            // the time from the earlier state to the present state, not 0
  const PatchSet *patches_before = nullptr;  // the patches of the earlier state, if they are known
};

// A direction in which a valve changes, given by two near states (motion/vertex_rates.hpp).
struct ValveDirection {
  const Valve &after, &before;
  Placement placement_after, placement_before;
  double step;
};

struct SurfaceSeconds {
  double triangles, scene;
};

// Both functions named make_surface replace the content of `surface` and reuse its memory. After a failure, the only permitted
// use of `surface` is to make it again. The first function fails as the stages of the pipeline do. It also fails with
// RIIS_INVALID_PARAMETER for a valve without area, and for two states that are built differently. Without an earlier state, the
// vertices have no velocity. `fixed` is null if accuracy.is_fixed is false. With an offset, both functions fail with
// RIIS_INVALID_SURFACE if two neighbouring triangles have opposite windings.
SurfaceSeconds make_surface(const Valve &valve, const EarlierValve *moved, const SurfaceRequest &request,
                            const ValveAccuracy &accuracy, const FixedTriangulation *fixed, Surface &surface);
SurfaceSeconds make_surface(const UserFaces &faces, const riis_surface_arrays &arrays, bool skip_zero_area,
                            const SurfaceRequest &request, Surface &surface);
// Adds a direction to the surface of a valve. Fails with RIIS_INVALID_PARAMETER if the patches of a state do not correspond to
// the valve's patches.
void add_direction(const ValveDirection &direction, int n_threads, Surface &surface);

}  // namespace riis
