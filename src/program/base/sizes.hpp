// SPDX-License-Identifier: Apache-2.0
// In: the sizes of a mesh and of a valve in it. Out: whether they fit together, and the unit and the half thickness that would
// fit.
// The program's warnings and the lights of Python's view share these rules.
#pragma once

#include <optional>

namespace riis::program {

struct Box {
  double lower[3], upper[3];
  double largest_side() const;
};

struct Sizes {
  Box mesh, surface;
  double median_edge;  // of the mesh; 0 if unknown
  double half_thickness;
  double translation[3];  // of the surface; it has the mesh's unit already
  bool is_unit_known;     // the user named the unit, so only the position can be wrong if the sizes fit
  bool has_usual_half;    // the half thickness is the default of a parametric valve
  double most_sure;       // a mesh of unknown unit that is more valves wide may have another unit
};

// Both limits of the half thickness are shares of the surface's largest side. The paper's half thickness, 0.1 cm, is 0.04 of the
// largest side of its aortic valve.
inline constexpr double usual_half_thickness = 0.04, largest_half_thickness = 0.25;

// is_too_large returns whether the half thickness is larger than a quarter of the surface. is_too_small returns whether it is so
// small that the band falls between the mesh's nodes.
bool is_too_large(double half_thickness, const Sizes &sizes);
bool is_too_small(double half_thickness, const Sizes &sizes);
// Returns a half thickness that fits: the present one times a power of ten. If none fits, returns the mesh's edge length, or 0 if
// this length does not fit either.
double better_half_thickness(const Sizes &sizes);

// The number of valves that fit into a mesh for which no other unit is possible.
inline constexpr double largest_mesh = 40;
// Returns whether a mesh whose lengths are multiplied by the factor has the size and the edges of a mesh with this valve.
bool sizes_fit_at(double factor, const Sizes &sizes);
// Returns the factor that makes the mesh's lengths fit the surface's. Returns none if they already fit, or if no power of ten
// helps.
std::optional<double> missing_factor(const Sizes &sizes);
// Returns the sizes as they would be with the surface scaled to fit the mesh.
Sizes rescaled(const Sizes &sizes, double factor);

}  // namespace riis::program
