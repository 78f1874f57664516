// SPDX-License-Identifier: Apache-2.0
#include "accuracy/smooth_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace riis::accuracy {
namespace {

// Computes the larger principal curvature from the fundamental forms.
double largest_curvature(Vec3 su, Vec3 sv, const std::array<Vec3, 3> &second, Vec3 normal) {
  const double e = dot(su, su), f = dot(su, sv), g = dot(sv, sv), determinant = e * g - f * f;
  const double l = dot(second[0], normal), m = dot(second[1], normal), n = dot(second[2], normal);
  const double mean = (e * n - 2 * f * m + g * l) / (2 * determinant), gauss = (l * n - m * m) / determinant;
  return std::abs(mean) + std::sqrt(std::max(mean * mean - gauss, 0.0));
}

}  // namespace

SmoothSurface::SmoothSurface(const PatchSet &set) {
  for (const Patch &patch : set.patches) {
    SmoothPatch smooth{along(set, patch.v0), along(set, patch.v1), {}, {}, {}};
    if (patch.bulge != 0)
      smooth.bulge.emplace(smooth.v0, smooth.v1, patch.bulge);
    else {
      smooth.u0.emplace(along(set, patch.u0));
      smooth.u1.emplace(along(set, patch.u1));
    }
    for (const PatchImage &image : patch.images) images_.push_back({patches_.size(), image});
    patches_.push_back(std::move(smooth));
  }
}

std::size_t SmoothSurface::image_of(std::int32_t patch_id) const {
  const auto found =
      std::find_if(images_.begin(), images_.end(), [&](const Image &of) { return of.image.patch_id == patch_id; });
  if (found == images_.end()) throw std::out_of_range("there is no patch " + std::to_string(patch_id));
  return static_cast<std::size_t>(found - images_.begin());
}

SmoothSurface::AcrossU SmoothSurface::across_u(const SmoothPatch &patch, double u) const {
  return {patch.v0.at(u), patch.v1.at(u), patch.bulge ? patch.bulge->place(u).offset : Vec3{0, 0, 0}};
}

SmoothSurface::AcrossV SmoothSurface::across_v(const SmoothPatch &patch, double v) const {
  if (patch.bulge) return {{0, 0, 0}, {0, 0, 0}};
  return {patch.u0->at(v), patch.u1->at(v)};
}

Vec3 SmoothSurface::blend(const SmoothPatch &patch, double u, double v, const AcrossU &c, const AcrossV &d) {
  const Vec3 across_v = mix(c.c0, c.c1, v);
  if (patch.bulge) return across_v + 2 * v * (1 - v) * c.offset;
  const Vec3 corners = mix(mix(patch.v0.first(), patch.v0.last(), u), mix(patch.v1.first(), patch.v1.last(), u), v);
  return across_v + mix(d.d0, d.d1, u) - corners;
}

Vec3 SmoothSurface::at(std::size_t image, double u, double v) const {
  const Image &of = images_.at(image);
  const SmoothPatch &patch = patches_[of.patch];
  return place(of.image, blend(patch, u, v, across_u(patch, u), across_v(patch, v)));
}

std::vector<Vec3> SmoothSurface::at_lines(std::size_t image, const std::vector<double> &u,
                                          const std::vector<double> &v) const {
  const Image &of = images_.at(image);
  const SmoothPatch &patch = patches_[of.patch];
  std::vector<AcrossU> c;
  for (const double at_u : u) c.push_back(across_u(patch, at_u));
  std::vector<Vec3> points;
  points.reserve(u.size() * v.size());
  for (const double at_v : v) {
    const AcrossV d = across_v(patch, at_v);
    for (std::size_t i = 0; i < u.size(); ++i) points.push_back(place(of.image, blend(patch, u[i], at_v, c[i], d)));
  }
  return points;
}

SurfacePoint SmoothSurface::describe(std::size_t image, double u, double v) const {
  const std::vector<Vec3> s = at_lines(image, {u - step, u, u + step}, {v - step, v, v + step});
  const Vec3 su = (0.5 / step) * (s[5] - s[3]), sv = (0.5 / step) * (s[7] - s[1]);
  const double per_square = 1 / (step * step);
  const std::array<Vec3, 3> second{per_square * ((s[5] - s[4]) - (s[4] - s[3])),
                                   0.25 * per_square * ((s[8] - s[6]) - (s[2] - s[0])),
                                   per_square * ((s[7] - s[4]) - (s[4] - s[1]))};
  const Vec3 across = cross(su, sv);
  const double size = length(across);
  if (!(size > 1e-9 * length(su) * length(sv))) return {s[4], {0, 0, 0}, std::numeric_limits<double>::infinity()};
  const Vec3 normal = ((images_[image].image.mirror != Mirror::none ? -1 : 1) / size) * across;
  return {s[4], normal, largest_curvature(su, sv, second, normal)};
}

}  // namespace riis::accuracy
