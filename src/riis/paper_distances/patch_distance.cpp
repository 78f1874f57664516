// SPDX-License-Identifier: Apache-2.0
#include "paper_distances/patch_distance.hpp"

#include <riis/riis.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/errors.hpp"
#include "base/log.hpp"
#include "common/array_view.hpp"
#include "paper_distances/powell.hpp"
#include "triangulate/grids.hpp"

namespace riis {
namespace {

// Distances by minimisation (paper, 4.1 "Minimization"): Powell's method minimises |S(u,v) - P|^2 on every patch, starting at
// (0.5, 0.5). Powell's method ends in a local minimum. The result is therefore the distance to some point of S, but this point is
// not always the closest (docs/theory/paper-distances.md).
// The result is the least of the local minima of all patches.

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

  // Replaces `best` if the local minimum on this patch is lower.
  void query(std::int64_t patch, Vec3 p, ClosestOnPatches &best) const;
  double lower_bound(const Bounds &box, Vec3 p) const;

  double enough_;
  double rounding_ = 0;               // the largest distance of a computed point S(u,v) from its patch's box
  std::vector<PatchExtent> extents_;  // one for each patch
  Bounds box_;                        // the box of all patches together
};

Minimizer::Minimizer(PlacedPatches patches, double enough) : PatchDistance(std::move(patches)), enough_(enough) {
  double largest = 0;
  for (const PlacedPatch &patch : patches_.patches) {
    const Speeds speeds = largest_speeds(patch.grid);
    extents_.push_back({bounds_of(patch.grid), speeds.u, speeds.v});
    box_.add(extents_.back().box);
    largest = std::max(largest, extents_.back().box.largest_coordinate());
  }
  // A computed point is the result of three linear interpolations. Each interpolation is accurate to two units of rounding in
  // each of three coordinates.
  rounding_ = 0x1p-49 * largest;
}

double Minimizer::lower_bound(const Bounds &box, Vec3 p) const {
  return std::sqrt(box.distance_sq_to(p)) * (1 - 1e-15) - rounding_;
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
  // Returns the allowed error of a search along a line. An error of this size moves the point S by at most a tenth of `enough`.
  // An error below 1e-9 would be lost in the rounding of the squared distance.
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
  // Starts with the patch whose box is nearest. No point of a patch is nearer than the patch's box, so most of the other patches
  // are then too far to be searched.
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

// The patches deviate from the smooth surface by at most `patch_share` times the allowed error. This factor is small, because
// additional grid lines cost less than additional samples.
constexpr double patch_share = 0.1;

PlacedPatches make_patches(const PatchSet &set, double max_error, const Placement &placement, bool flip_normals) {
  try {
    return PlacedPatches(set, patch_share * max_error / placement.scale, placement, flip_normals);
  } catch (const Error &error) {
    fail(error.status, "with a tenth of measure_tolerance for the patches themselves, ", error.message.text());
  }
}

}  // namespace

std::unique_ptr<const PatchDistance> make_distance(const PatchSet &set, const DistanceRequest &request,
                                                   const Placement &placement, bool flip_normals) {
  PlacedPatches patches = make_patches(set, request.max_error, placement, flip_normals);
  const std::size_t n_patches = patches.patches.size();
  if (request.method == RIIS_MEASURE_MINIMIZATION)
    return std::make_unique<const Minimizer>(std::move(patches), request.max_error);
  auto samples = std::make_unique<const SampleSet>(std::move(patches), request.max_error);
  log_message(RIIS_LOG_INFO, "distances by sampling: ", samples->n_samples(), " samples of ", n_patches, " patches");
  return samples;
}

Vec3 PlacedPatch::normal_at(double u, double v) const {
  const std::size_t i = interval_of(grid.u, u), j = interval_of(grid.v, v);
  const double s = (u - grid.u[i]) / (grid.u[i + 1] - grid.u[i]), t = (v - grid.v[j]) / (grid.v[j + 1] - grid.v[j]);
  const Vec3 p00 = grid.point(i, j), p10 = grid.point(i + 1, j);
  const Vec3 p01 = grid.point(i, j + 1), p11 = grid.point(i + 1, j + 1);
  const Vec3 along_u = mix(p10 - p00, p11 - p01, t), along_v = mix(p01 - p00, p11 - p10, s);
  const double size_u = length(along_u), size_v = length(along_v);
  if (!(size_u > 0 && size_v > 0)) return {0, 0, 0};
  const Vec3 across = cross((1 / size_u) * along_u, (1 / size_v) * along_v);
  const double size = length(across);
  // A vector shorter than this limit is only a rounding error. The function has_zero_area uses the same limit.
  if (!(size > 1e-12)) return {0, 0, 0};
  return ((is_turned_over ? -1 : 1) / size) * across;
}

PlacedPatches::PlacedPatches(const PatchSet &set, double max_error, const Placement &placement, bool flip_normals) {
  std::size_t number = 0;
  for (const QuadGrid &grid : make_grids(set, error_left(set, max_error))) {
    const double error = *std::max_element(grid.errors.begin(), grid.errors.end()) + set.deviation;
    for (const PatchImage &image : set.patches[number].images) {
      QuadGrid placed{grid.u, grid.v, {}, {}};
      placed.points.reserve(grid.points.size());
      for (const Vec3 &p : grid.points) placed.points.push_back(place(placement, place(image, p)));
      patches.push_back({std::move(placed), image.leaflet_id, image.patch_id, points_upstream(image) != flip_normals});
      errors.push_back(error * placement.scale);
    }
    ++number;
  }
}

double PlacedPatches::largest_error() const { return *std::max_element(errors.begin(), errors.end()); }

Speeds largest_speeds(const QuadGrid &grid) {
  Speeds largest{0, 0};
  for_each_derivatives(grid, [&](const auto &along_u, const auto &along_v) {
    for (const Vec3 &a : along_u) largest.u = std::max(largest.u, length(a));
    for (const Vec3 &a : along_v) largest.v = std::max(largest.v, length(a));
  });
  return largest;
}

Bounds bounds_of(const QuadGrid &grid) {
  Bounds box;
  for (const Vec3 &p : grid.points) box.add(p);
  return box;
}

}  // namespace riis
