// SPDX-License-Identifier: Apache-2.0
#include "accuracy.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "accuracy/ground_truth.hpp"
#include "accuracy/methods.hpp"
#include "accuracy/smooth_surface.hpp"
#include "base/errors.hpp"
#include "valve/user_patches.hpp"

namespace {

using namespace riis::accuracy;

static_assert(n_offsets == offsets.size());

double *copy_of(const std::vector<double> &values) {
  auto *copy = static_cast<double *>(std::malloc(values.size() * sizeof(double) + 1));
  if (copy) std::memcpy(copy, values.data(), values.size() * sizeof(double));
  return copy;
}

known_points copy_of(const TruePoints &points) {
  return {static_cast<std::int64_t>(points.n()), copy_of(points.xyz), copy_of(points.distance)};
}

template <class Body>
int reported(const Body &body) {
  try {
    body();
    return 0;
  } catch (const riis::Error &error) {
    std::fprintf(stderr, "%s\n", error.message.text());
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  return 1;
}

riis::PatchSet leaflet_of(const std::string &kind) {
  for (const Leaflet &leaflet : leaflets)
    if (kind == leaflet.valve) return patches_of(leaflet);
  throw std::invalid_argument(kind);
}

}  // namespace

extern "C" {

int truth_of(const riis_patches *patches, const char *kind, int64_t n, uint64_t seed, double fine_tolerance,
             known_truth *truth) {
  return reported([&] {
    const GroundTruth made = make_ground_truth(patches ? riis::patches_from_arrays(*patches) : leaflet_of(kind),
                                               {static_cast<std::size_t>(n), seed, fine_tolerance});
    *truth = {copy_of(made.on_surface), copy_of(made.off_surface), made.n_curved, made.n_nearer, made.most_from_fine};
  });
}

void truth_free(known_truth *truth) {
  for (const known_points &points : {truth->on, truth->off}) {
    std::free(points.xyz);
    std::free(points.distance);
  }
}

double truth_offset(int64_t i) { return offsets[static_cast<std::size_t>(i) % offsets.size()]; }

double truth_largest_share_of_radius(void) { return largest_share_of_radius; }

int smooth_point(const riis_patches *patches, double u, double v, double *point, double *normal, double *curvature) {
  return reported([&] {
    const SurfacePoint at = SmoothSurface(riis::patches_from_arrays(*patches)).describe(0, u, v);
    const double values[6] = {at.point.x, at.point.y, at.point.z, at.normal.x, at.normal.y, at.normal.z};
    std::memcpy(point, values, 3 * sizeof(double));
    std::memcpy(normal, values + 3, 3 * sizeof(double));
    *curvature = at.curvature;
  });
}
}
