// SPDX-License-Identifier: Apache-2.0
// Units of length: the units that --unit and --surface-unit accept, boxes, and the guess of a unit from sizes.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace riis::program {

enum class Unit { metre, centimetre, millimetre };

// The next functions return the names of units. Options use names such as "m", and messages use words such as "metres".
const std::vector<std::string> &unit_names();
const char *name_of(Unit unit);
const char *words_of(Unit unit);
// Returns the unit with this name, or none for "".
std::optional<Unit> unit_of(const std::string &name);

// Returns the factor from one unit to the other. For example, the factor from centimetres to metres is 0.01.
double factor_between(Unit from, Unit to);
// Returns the paper's half thickness, which is 0.1 cm, in the given unit.
double paper_half_thickness(Unit unit);

// Returns the unit into which `factor` converts lengths from the unit `from`, or none.
std::optional<Unit> unit_reached(Unit from, double factor);
// Returns the surface's unit and the mesh's unit if the factor converts lengths from the first of these units to the second.
// Returns nothing for the factor 1, and for a factor that belongs to no pair of units.
struct UnitPair {
  Unit surface, mesh;
};
std::optional<UnitPair> units_of_factor(double factor);
// Returns the unit in which the given number is the size of a heart valve. Heart valves are about 1 to 10 centimetres large.
std::optional<Unit> unit_of_valve(double largest_side);

// A box whose sides are parallel to the axes.
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
  // Returns the box with each side moved outwards by the length `by`.
  Box widened(double by) const {
    return {{lower[0] - by, lower[1] - by, lower[2] - by}, {upper[0] + by, upper[1] + by, upper[2] + by}};
  }
  bool contains(const double *point) const { return meets(point, point); }
  bool meets(const Box &other) const { return meets(other.lower, other.upper); }
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

// Collects sums over points, from which their moments follow. The moments tell how far the points reach along their principal
// axes. A narrow vessel that lies obliquely therefore does not count as wide.
struct Moments {
  double n = 0, sum[3]{}, squares[6]{};  // squares has xx, yy, zz, xy, xz, yz

  void add(const double *point);
  void add(const Moments &other);
};

// Returns the three sides of a mesh, the longest first. The length of a side is the shorter of two lengths. One is the side of
// the box, and the other is the diameter of a disc with the same moment as the points. Without points, the sides of the box are
// returned.
std::array<double, 3> sides_of(const Box &box, const Moments &moments);

// The sizes of a mesh and of a valve in the mesh. The functions below tell whether the sizes of mesh and valve fit together, and
// which unit and which half thickness would fit. The program's warnings and the lights of riis view (docs/view.md) follow the
// same rules.
struct Sizes {
  std::array<double, 3> mesh_sides;  // the longest first
  Box surface;
  double median_edge;  // of the mesh; 0 if unknown
  double half_thickness;
  bool is_unit_known = false;   // the user named the unit
  bool has_usual_half = false;  // the half thickness is the default of a parametric valve
  double near_edge = 0;         // about the length of edges near the surface; 0 if unknown
  double unnamed_factor = 1;    // the factor of the unit that a run has without --unit
};

// The limits of the half thickness, as shares of the surface's largest side. The paper's half thickness, 0.1 cm, is 0.04 of the
// largest side of its aortic valve.
inline constexpr double usual_half_thickness = 0.04, largest_half_thickness = 0.25;

// is_too_large returns whether the half thickness is above a quarter of the surface's largest side. is_too_small returns whether
// the band is so thin that it falls between the mesh's nodes.
bool is_too_large(double half_thickness, const Sizes &sizes);
bool is_too_small(double half_thickness, const Sizes &sizes);
// Returns a half thickness that fits: the present one times a power of ten. If no power fits, returns the mesh's edge length. If
// the edge length does not fit either, returns 0.
double better_half_thickness(const Sizes &sizes);

// The judgement of a mesh's unit. A factor stands for a unit of the mesh, because it converts the mesh's lengths to the surface's
// unit.
struct UnitJudgement {
  bool is_right;  // the sizes fit the present unit, so there is no advice
  std::vector<double>
      factors;  // all that are possible, the likeliest first; 1 is the present unit; empty if none is possible

  bool is_possible(double factor) const { return std::find(factors.begin(), factors.end(), factor) != factors.end(); }
};

// Judges the present unit, whose factor is 1, and the unit of each factor in `factors`. `factors` may leave out the factor 1. A
// coarse basin in centimetres can have the same numbers as a vessel in millimetres. If the user named no unit, the present unit
// therefore stays possible, even if another unit is likelier.
UnitJudgement judge_units(const Sizes &sizes, const std::vector<double> &factors);
// Returns whether the factor makes the mesh about as wide as the surface.
bool is_as_wide(const Sizes &sizes, double factor);
// All factors between two different units.
const std::vector<double> &unit_factors();
// Returns the sizes after the surface is scaled to fit the mesh.
Sizes rescaled(const Sizes &sizes, double factor);

}  // namespace riis::program
