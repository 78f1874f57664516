// SPDX-License-Identifier: Apache-2.0
#include "measures/measures.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "geometry/coons.hpp"
#include "geometry/curve.hpp"
#include "motion/displacement.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// An interval of openings is cut at all multiples of 1 / n_steps. Overlapping intervals thus have the same cuts, so the volumes
// of adjacent intervals add up. Between two cuts, each point moves along a straight line.
constexpr int n_steps = 64;

// Each patch is cut into n by n quads. The number n is chosen between `fewest` and `most`, so that the whole valve has about
// quads_wanted quads.
constexpr double quads_wanted = 65536;
constexpr int fewest = 8, most = 64;

// Returns the volume that a triangle sweeps while its corners move along straight lines. The result is exact. It is the mean
// shift of the corners, multiplied by the time average of the area vector.
double swept(const Vec3 (&from)[3], const Vec3 (&to)[3]) {
  const Vec3 e = from[1] - from[0], f = from[2] - from[0];
  const Vec3 de = (to[1] - to[0]) - e, df = (to[2] - to[0]) - f;
  const Vec3 twice_area = cross(e, f) + 0.5 * (cross(e, df) + cross(de, f)) + (1.0 / 3) * cross(de, df);
  const Vec3 shifts = (to[0] - from[0]) + (to[1] - from[1]) + (to[2] - from[2]);
  return dot(shifts, twice_area) / 6;
}

Vector<Vec3> points_on(const PatchSet &set, const Side &side, const Vector<double> &shares) {
  const CurvePoints points(set.curve_of(side), side.reversed, shares);
  Vector<Vec3> made;
  made.reserve(shares.size());
  for (std::size_t i = 0; i < shares.size(); ++i) made.push_back(points.point(i));
  return made;
}

// Returns the points of a patch at all (u, v) whose u and v are given shares, in the order of QuadGrid::points.
Vector<Vec3> points_of(const PatchSet &set, const Patch &patch, const Vector<double> &shares) {
  SideVectors sides{points_on(set, patch.v0, shares), points_on(set, patch.v1, shares), {}, {}};
  if (patch.bulge == 0) {
    sides.u0 = points_on(set, patch.u0, shares), sides.u1 = points_on(set, patch.u1, shares);
    return coons_combination(shares, shares, sides);
  }
  const CurvePoints base(set.curve_of(patch.v0), patch.v0.reversed, shares);
  const CurvePoints edge(set.curve_of(patch.v1), patch.v1.reversed, shares);
  const Vector<Vec3> offsets = arc_offsets(set, patch, base, edge);
  Vector<Vec3> made;
  made.reserve(shares.size() * shares.size());
  for (const double v : shares)
    for (std::size_t i = 0; i < shares.size(); ++i)
      made.push_back(mix(sides.v0[i], sides.v1[i], v) + (2 * v * (1 - v)) * offsets[i]);
  return made;
}

double swept_by_grid(const Vector<Vec3> &from, const Vector<Vec3> &to, std::size_t n) {
  double sum = 0;
  for (std::size_t j = 0; j + 1 < n; ++j)
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const std::size_t a = j * n + i, b = a + 1, c = b + n, d = a + n;
      sum += swept({from[a], from[b], from[c]}, {to[a], to[b], to[c]}) +
             swept({from[a], from[c], from[d]}, {to[a], to[c], to[d]});
    }
  return sum;
}

Vector<Vec3> placed(const PatchImage &image, const Vector<Vec3> &points) {
  Vector<Vec3> made;
  made.reserve(points.size());
  for (const Vec3 &p : points) made.push_back(place(image, p));
  return made;
}

void add_swept(const PatchSet &from, const PatchSet &to, const Vector<double> &shares, SweptVolumes &sums) {
  for (std::size_t k = 0; k < from.patches.size(); ++k) {
    const Patch &before = from.patches[k], &now = to.patches[k];
    const Vector<Vec3> points_before = points_of(from, before, shares), points_now = points_of(to, now, shares);
    for (std::size_t i = 0; i < before.images.size(); ++i) {
      const PatchImage &image = before.images[i];
      const double volume =
          swept_by_grid(placed(image, points_before), placed(now.images[i], points_now), shares.size());
      // The normals of a mirror image would point upstream, so its triangles are turned over. The sign of the volume that they
      // sweep therefore changes.
      sums[image.leaflet_id] += points_upstream(image) ? -volume : volume;
    }
  }
}

Vector<double> even_shares(const PatchSet &set) {
  double n_images = 0;
  for (const Patch &patch : set.patches)
    if (!patch.is_skirt) n_images += static_cast<double>(patch.images.size());  // a skirt changes no leaflet's volume
  const int n = static_cast<int>(std::clamp(std::sqrt(quads_wanted / n_images), double{fewest}, double{most}));
  Vector<double> shares;
  for (int i = 0; i <= n; ++i) shares.push_back(static_cast<double>(i) / n);
  return shares;
}

PatchSet patches_at(const Valve &valve, double opening) {
  Valve moved = valve;
  moved.set("opening", 1, &opening);
  return moved.make_patches();
}

void add(const SweptVolumes &from, SweptVolumes &to) {
  for (const auto &[id, volume] : from) to[id] += volume;
}

}  // namespace

SweptVolumes swept_volumes(const Valve &valve, double opening_from, double opening_to, int n_threads) {
  if (opening_from > opening_to) {
    SweptVolumes back = swept_volumes(valve, opening_to, opening_from, n_threads);
    for (auto &[id, volume] : back) volume = -volume;
    return back;
  }
  if (!valve.can_open()) patches_at(valve, opening_to);  // the message of a failure names the caller's opening
  std::vector<double> openings{opening_from};
  for (int i = 1; i < n_steps; ++i) {
    const double opening = static_cast<double>(i) / n_steps;
    if (opening > opening_from && opening < opening_to) openings.push_back(opening);
  }
  openings.push_back(opening_to);
  const auto n = view(openings).size() - 1;
  std::vector<SweptVolumes> by_step(openings.size() - 1);
  parallel_for(n, n_threads, [&](std::int64_t i, int) {
    const PatchSet from = patches_at(valve, view(openings)[i]), to = patches_at(valve, view(openings)[i + 1]);
    check_same_build(to, from);
    add_swept(from, to, even_shares(from), view(by_step)[i]);
  });
  SweptVolumes sums;
  for (const SweptVolumes &step : by_step) add(step, sums);
  return sums;
}

}  // namespace riis
