// SPDX-License-Identifier: Apache-2.0
// Units of length, and sizes that suggest one: the units that --unit and --surface-unit accept, boxes, and the guess of a unit.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace riis::program {

enum class Unit { metre, centimetre, millimetre };

// The next functions return the names of units: those in options, such as "m", and those in messages, such as "metres".
const std::vector<std::string> &unit_names();
const char *name_of(Unit unit);
const char *words_of(Unit unit);
// Returns the unit with one of the names in unit_names(), or none for "".
std::optional<Unit> unit_of(const std::string &name);

// Returns the factor from one unit to the other. For example, it is 0.01 from centimetres to metres.
double factor_between(Unit from, Unit to);
// Returns the paper's half thickness, which is 0.1 cm, in the given unit.
double paper_half_thickness(Unit unit);

// Returns the unit that equals `from` times the factor, or none.
std::optional<Unit> unit_reached(Unit from, double factor);
// Returns the units of surface and mesh between which the factor converts. Returns none for other factors and for 1.
struct UnitPair {
  Unit surface, mesh;
};
std::optional<UnitPair> units_of_factor(double factor);
// Returns the unit in which this number is the size of a heart valve, about 1 to 10 centimetres.
std::optional<Unit> unit_of_valve(double largest_side);

// A box along the axes.
struct Box {
  double lower[3], upper[3];

  double largest_side() const { return std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]}); }
  void grow(const double *least, const double *most) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], least[k]);
      upper[k] = std::max(upper[k], most[k]);
    }
  }
  void grow(const double *point) { grow(point, point); }
  void grow(const Box &other) { grow(other.lower, other.upper); }
  bool contains(const double *point) const { return meets(point, point); }
  bool meets(const double *other_lower, const double *other_upper) const {
    for (int k = 0; k < 3; ++k)
      if (upper[k] < other_lower[k] || lower[k] > other_upper[k]) return false;
    return true;
  }
};

// Returns a box that contains nothing.
inline Box empty_box() {
  constexpr double far = std::numeric_limits<double>::infinity();
  return {{far, far, far}, {-far, -far, -far}};
}

// The number of valves that fit into a mesh for which no other unit is possible.
inline constexpr double largest_mesh = 40;

// The sizes of a mesh and of a valve in it. The functions below tell whether they fit together, and which unit and which half
// thickness would fit. The program's warnings and the lights of Python's view share these rules.
struct Sizes {
  Box mesh, surface;
  double median_edge;  // of the mesh; 0 if unknown
  double half_thickness;
  double translation[3]{};          // of the surface; it has the mesh's unit already
  bool is_unit_known = false;       // the user named the unit, so only the position can be wrong if the sizes fit
  bool has_usual_half = false;      // the half thickness is the default of a parametric valve
  double most_sure = largest_mesh;  // a mesh of unknown unit that is more valves wide may have another unit
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

// Returns whether a mesh whose lengths are multiplied by the factor has the size and the edges of a mesh with this valve.
bool sizes_fit_at(double factor, const Sizes &sizes);
// Returns the factor that makes the mesh's lengths fit the surface's. Returns none if they already fit, or if no power of ten
// helps.
std::optional<double> missing_factor(const Sizes &sizes);
// Returns the sizes as they would be with the surface scaled to fit the mesh.
Sizes rescaled(const Sizes &sizes, double factor);

}  // namespace riis::program
