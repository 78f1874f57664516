// SPDX-License-Identifier: Apache-2.0
// A triangulation that stays the same while a valve opens and closes (docs/theory.md, "Fixed triangulation").
// In: a valve, the allowed error. Out: the plan of the triangles, good at all openings.
#pragma once

#include "surface/triangulate.hpp"
#include "valve/valve.hpp"

namespace riis {

class FixedTriangulation {
 public:
  // max_error bounds the distance between triangles and smooth surface, before placement. Fails as the stages of the
  // pipeline do, and names the opening.
  FixedTriangulation(const Valve &valve, double max_error, int n_threads);

  // Fails with RIIS_INVALID_PARAMETER unless the valve is the one of the plan, at any opening.
  void check(const Valve &valve) const { valve_.check_same_but_for_opening(valve); }
  const TriangulationPlan &plan() const { return plan_; }

 private:
  Valve valve_;
  TriangulationPlan plan_;
};

}  // namespace riis
