// SPDX-License-Identifier: Apache-2.0
#include "paper_distances/patch_distance.hpp"

#include <riis/riis.h>

#include <utility>

#include "base/errors.hpp"
#include "base/log.hpp"
#include "paper_distances/minimizer.hpp"
#include "paper_distances/sample_set.hpp"

namespace riis {
namespace {

// The patches deviate from the smooth surface by at most this share of the allowed error. The share is small, because more grid
// lines are cheaper than more samples.
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

}  // namespace riis
