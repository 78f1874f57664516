// SPDX-License-Identifier: Apache-2.0
#include "measures/penetration.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace riis {
namespace {

// Finds the least overlap of two triangles over the directions that are passed to along(). Each face of the Minkowski difference
// of two triangles has the normal of one triangle, or it is spanned by an edge of each. So the least overlap over these normals
// is the distance from the origin to the boundary of the difference. This distance is the penetration depth.
class Overlap {
 public:
  Overlap(const Triangle &a, const Triangle &b, double limit) : a_(a), b_(b), limit_(limit) {}

  double least() const { return least_; }

  // Takes one more direction into account. Returns whether the least overlap is still above the limit.
  bool along(Vec3 w) {
    const auto [a_low, a_high] = extent(w, a_);
    const auto [b_low, b_high] = extent(w, b_);
    least_ = std::min(least_, std::min(a_high - b_low, b_high - a_low) / length(w));
    return least_ > limit_;
  }

 private:
  static std::pair<double, double> extent(Vec3 w, const Triangle &t) {
    const double x = dot(w, t[0]), y = dot(w, t[1]), z = dot(w, t[2]);
    return {std::min({x, y, z}), std::max({x, y, z})};
  }

  const Triangle &a_, &b_;
  double limit_, least_ = std::numeric_limits<double>::infinity();
};

Triangle moved(const Triangle &t, Vec3 origin) { return {t[0] - origin, t[1] - origin, t[2] - origin}; }

std::array<Vec3, 3> edges_of(const Triangle &t) { return {t[1] - t[0], t[2] - t[1], t[0] - t[2]}; }

// Returns whether t reaches beyond the limit on both sides of a plane. The corners of t are relative to a point of the plane, and
// w is the plane's normal.
bool cuts_plane(const Triangle &t, Vec3 w, double limit) {
  const double x = dot(w, t[0]), y = dot(w, t[1]), z = dot(w, t[2]), least = limit * length(w);
  return std::max({x, y, z}) > least && -std::min({x, y, z}) > least;
}

// Returns whether e and f, whose cross product is w, are so parallel that their parallelogram is narrower than 1e-8 of an edge.
bool are_parallel(Vec3 w, Vec3 e, Vec3 f) { return dot(w, w) <= 1e-16 * dot(e, e) * dot(f, f); }

}  // namespace

double penetration_depth(const Triangle &a, const Triangle &b, double limit) {
  // Most pairs of triangles are dismissed here, because one triangle does not cut the plane of the other. Points are relative to
  // a corner of that plane's triangle, so the plane's height is exactly 0.
  const Vec3 normal_a = cross(a[1] - a[0], a[2] - a[0]), normal_b = cross(b[1] - b[0], b[2] - b[0]);
  const Triangle b_from_a = moved(b, a[0]);
  if (!cuts_plane(b_from_a, normal_a, limit) || !cuts_plane(moved(a, b[0]), normal_b, limit)) return 0;
  const Triangle a_from_a = moved(a, a[0]);
  Overlap overlap(a_from_a, b_from_a, limit);
  if (!overlap.along(normal_a) || !overlap.along(normal_b)) return 0;
  for (const Vec3 e : edges_of(a_from_a))
    for (const Vec3 f : edges_of(b)) {
      const Vec3 w = cross(e, f);
      if (!are_parallel(w, e, f) && !overlap.along(w)) return 0;
    }
  return overlap.least();
}

CommonSegment common_segment(const Triangle &a, const Triangle &b) {
  const Vec3 normal = cross(b[1] - b[0], b[2] - b[0]);
  const Triangle from_b = moved(a, b[0]);
  std::array<double, 3> height{};
  for (std::size_t k = 0; k < 3; ++k) height[k] = dot(normal, from_b[k]);
  // One corner is alone on its side of b's plane.
  const auto is_below = [&](std::size_t k) { return height[k % 3] < 0; };
  std::size_t lone = 0;
  while (lone < 2 && (is_below(lone) == is_below(lone + 1) || is_below(lone) == is_below(lone + 2))) ++lone;
  const auto cut = [&](std::size_t other) {
    return mix(from_b[lone], from_b[other], height[lone] / (height[lone] - height[other]));
  };
  const Vec3 p = cut((lone + 1) % 3), q = cut((lone + 2) % 3);
  double low = 0, high = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 inward = cross(normal, b[(k + 1) % 3] - b[k]), corner = b[k] - b[0];
    const double at_p = dot(inward, p - corner), at_q = dot(inward, q - corner);
    if (at_p < 0 && at_q > at_p) low = std::max(low, at_p / (at_p - at_q));
    if (at_q < 0 && at_p > at_q) high = std::min(high, at_p / (at_p - at_q));
  }
  return {b[0] + mix(p, q, 0.5 * low + 0.5 * high), std::max(high - low, 0.0) * distance(p, q)};
}

}  // namespace riis
