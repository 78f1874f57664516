// SPDX-License-Identifier: Apache-2.0
// The input is a surface. The results are points on this surface, and each point stands for nearly the same share of its area.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

namespace riis::program {

// A run warns if more than this share of the leaflets' area is outside the mesh.
inline constexpr double most_outside = 0.02;

struct AreaSamples {
  std::vector<double> xyz;  // (3, n)
  std::vector<double> area;
  std::vector<std::int32_t> leaflet;
};

// Samples the leaflets, but not the skirt and the housing. Each triangle is divided into equal triangles, with a point in each.
AreaSamples area_samples(const riis_surface *surface);

}  // namespace riis::program
