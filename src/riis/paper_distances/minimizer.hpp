// SPDX-License-Identifier: Apache-2.0
// Distances by minimisation (paper, 4.1 "Minimization"): Powell's method minimises |S(u,v) - P|^2 on every patch, starting at
// (0.5, 0.5). It ends in a local minimum. So the result is always the distance to some point of S, but not always to the
// closest point (docs/theory.md, section 9).
// In: placed patches, the tolerance of the minimisation. Out: the least of all patches' local minima.
#pragma once

#include <vector>

#include "paper_distances/patch_distance.hpp"

namespace riis {

class Minimizer final : public PatchDistance {
 public:
  // Powell's method stops after an iteration that lowers the distance by no more than `enough`, in mesh units.
  Minimizer(PlacedPatches patches, double enough);

  ClosestOnPatches closest(Vec3 p, double limit) const override;
  bool may_be_within(Vec3 p, double limit) const override;
  bool is_of_fixed_points() const override { return false; }
  const char *name() const override { return "minimization"; }

 private:
  struct PatchExtent {
    Bounds box;
    double width, height;  // bounds of |S_u| and |S_v|
  };

  // Replaces `best` if the patch's local minimum is lower.
  void query(std::int64_t patch, Vec3 p, ClosestOnPatches &best) const;
  double lower_bound(const Bounds &box, Vec3 p) const;

  double enough_;
  double rounding_ = 0;               // how far a computed point S(u,v) may lie outside of its patch's box
  std::vector<PatchExtent> extents_;  // one for each patch
  Bounds box_;                        // the box of all patches together
};

}  // namespace riis
