// SPDX-License-Identifier: Apache-2.0
// A triangulation that stays the same while a valve opens and closes (docs/theory.md, "Fixed triangulation").
// In: a valve, the allowed error. Out: a plan of the triangles that serves all openings.
#pragma once

#include "triangulate/triangulate.hpp"
#include "valve/valve.hpp"

namespace riis {

class FixedTriangulation {
 public:
  // Makes the plan. max_error bounds the distance between triangles and the smooth surface, before placement. Fails as the stages
  // of the pipeline do. The message names the opening.
  FixedTriangulation(const Valve &valve, double max_error, int n_threads);

  // Fails with RIIS_INVALID_PARAMETER if the valve differs from the plan's valve in more than its opening and the values of its
  // warp.
  void check(const Valve &valve) const { valve_.check_same_but_for_opening(valve); }
  const TriangulationPlan &plan() const { return plan_; }

 private:
  Valve valve_;
  TriangulationPlan plan_;
};

}  // namespace riis
