// SPDX-License-Identifier: Apache-2.0
#include "program/base/area_samples.hpp"

#include <cmath>

#include "common/array_view.hpp"
#include "common/elementary.hpp"
#include "program/base/handles.hpp"

namespace riis::program {
namespace {

// The number of samples that are taken if the triangles are coarse. Each triangle has at least one sample.
constexpr double n_wanted = 20'000;

double area_of(const double *a, const double *b, const double *c) {
  const double p[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, q[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  return 0.5 * hypotenuse(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]);
}

// Yields points that fill a triangle evenly, in the order of Roberts's sequence. The corners of the triangle are (0, 0), (1, 0)
// and (0, 1). If every part of the triangle had its point at a fixed place, the points would form rows. A wall along such a row
// would then cut off too many or too few points.
class Places {
 public:
  struct Place {
    double u, v;
  };
  Place next() {
    u_ = std::fmod(u_ + 0.7548776662466927, 1);
    v_ = std::fmod(v_ + 0.5698402909980532, 1);
    return u_ + v_ > 1 ? Place{1 - u_, 1 - v_} : Place{u_, v_};
  }

 private:
  double u_ = 0.5, v_ = 0.5;
};

// Calls visit(u, v) with one point in each of the n * n equal parts of the triangle.
template <class Visit>
void for_each_part(std::int64_t n, Places &places, const Visit &visit) {
  const auto size = static_cast<double>(n);
  for (std::int64_t i = 0; i < n; ++i)
    for (std::int64_t j = 0; i + j < n; ++j) {
      const auto u = static_cast<double>(i), v = static_cast<double>(j);
      const Places::Place in = places.next();
      visit((u + in.u) / size, (v + in.v) / size);
      if (i + j + 1 == n) continue;
      const Places::Place turned = places.next();
      visit((u + 1 - turned.u) / size, (v + 1 - turned.v) / size);
    }
}

}  // namespace

AreaSamples area_samples(const riis_surface *surface) {
  const riis_surface_info info = info_of(surface);
  const riis_triangles triangles = triangles_of(surface);
  const auto corner = [&](std::int64_t face, int k) { return triangles.xyz + 3 * triangles.vertex_id[3 * face + k]; };
  std::vector<double> areas;
  double sum = 0;
  for (std::int64_t face = 0; face < triangles.n_triangles; ++face) {
    const std::int32_t id = triangles.leaflet_id[face];
    const bool is_leaflet = id != info.skirt_leaflet_id && id != info.housing_leaflet_id;
    areas.push_back(is_leaflet ? area_of(corner(face, 0), corner(face, 1), corner(face, 2)) : 0);
    sum += areas.back();
  }
  AreaSamples samples;
  Places places;
  for (std::int64_t face = 0; face < triangles.n_triangles; ++face) {
    const double area = view(areas)[face];
    if (!(area > 0)) continue;
    const double *const a = corner(face, 0), *const b = corner(face, 1), *const c = corner(face, 2);
    const auto n = static_cast<std::int64_t>(std::ceil(std::sqrt(n_wanted * (area / sum))));
    for_each_part(n, places, [&](double u, double v) {
      for (int k = 0; k < 3; ++k) samples.xyz.push_back(a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]));
      samples.area.push_back(area / static_cast<double>(n * n));
      samples.leaflet.push_back(triangles.leaflet_id[face]);
    });
  }
  return samples;
}

}  // namespace riis::program
