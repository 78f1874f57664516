// SPDX-License-Identifier: Apache-2.0
#include "paper_distances/minimizer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/array_view.hpp"
#include "paper_distances/powell.hpp"

namespace riis {

Minimizer::Minimizer(PlacedPatches patches, double enough) : PatchDistance(std::move(patches)), enough_(enough) {
  double largest = 0;
  for (const PlacedPatch &patch : patches_.patches) {
    const Speeds speeds = largest_speeds(patch.grid);
    extents_.push_back({bounds_of(patch.grid), speeds.u, speeds.v});
    const Bounds &box = extents_.back().box;
    box_.add(box);
    for (const Vec3 &p : {box.lower, box.upper})
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  // A computed point is the result of three linear interpolations. Each is accurate to two units of rounding in each of three
  // coordinates.
  rounding_ = 0x1p-49 * largest;
}

double Minimizer::lower_bound(const Bounds &box, Vec3 p) const {
  return std::sqrt(distance_sq_to(box, p)) * (1 - 1e-15) - rounding_;
}

bool Minimizer::may_be_within(Vec3 p, double limit) const { return lower_bound(box_, p) <= limit; }

void Minimizer::query(std::int64_t patch, Vec3 p, ClosestOnPatches &best) const {
  const PlacedPatch &of = view(patches_.patches)[patch];
  const PatchExtent &extents = view(extents_)[patch];
  const auto to_surface = [&](Parameters at) { return of.at(at.u, at.v) - p; };
  const auto distance_sq = [&](Parameters at) {
    const Vec3 d = to_surface(at);
    return dot(d, d);
  };
  // Returns the step along a line that moves the point S by at most a tenth of `enough`. A step shorter than 1e-9 would be lost
  // in the rounding of the squared distance.
  const auto step_of = [&](Parameters along) {
    const double speed = std::abs(along.u) * extents.width + std::abs(along.v) * extents.height;
    const double longest = std::max(std::abs(along.u), std::abs(along.v));
    return std::max(speed > 0 ? 0.1 * enough_ / speed : 0.0, 1e-9 / longest);
  };
  const LocalMinimum found = minimize_by_powell(distance_sq, {0.5, 0.5}, enough_, step_of);
  if (found.value < best.distance_sq || (found.value == best.distance_sq && patch < best.patch))
    best = {found.value, patch, found.at.u, found.at.v, of.at(found.at.u, found.at.v)};
}

ClosestOnPatches Minimizer::closest(Vec3 p, double limit) const {
  // Starts with the patch whose box is nearest. No point of a patch is nearer than the patch's box, so most other patches need no
  // query.
  const auto extents = view(extents_);
  std::int64_t first = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::int64_t i = 0; i < extents.size(); ++i) {
    const double bound = lower_bound(extents[i].box, p);
    if (bound < nearest) nearest = bound, first = i;
  }
  ClosestOnPatches best;
  if (!(nearest <= limit)) return best;
  query(first, p, best);
  for (std::int64_t i = 0; i < extents.size(); ++i) {
    if (i == first) continue;
    const double bound = lower_bound(extents[i].box, p);
    if (bound <= limit && bound <= std::sqrt(best.distance_sq)) query(i, p, best);
  }
  return std::sqrt(best.distance_sq) <= limit ? best : ClosestOnPatches{};
}

}  // namespace riis
