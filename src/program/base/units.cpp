// SPDX-License-Identifier: Apache-2.0

#include "program/base/units.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace riis::program {

namespace {

constexpr std::array<Unit, 3> all_units = {Unit::metre, Unit::centimetre, Unit::millimetre};

// The results are whole numbers, so that the quotient of two of them is the number that a user would write, such as 0.01.
double millimetres_of(Unit unit) { return unit == Unit::metre ? 1000 : unit == Unit::centimetre ? 10 : 1; }

bool is_about(double a, double b) { return std::abs(a - b) <= 1e-9 * b; }

}  // namespace

const std::vector<std::string> &unit_names() {
  static const std::vector<std::string> names = {"m", "cm", "mm"};
  return names;
}

const char *name_of(Unit unit) { return unit_names()[static_cast<std::size_t>(unit)].c_str(); }

const char *words_of(Unit unit) {
  return unit == Unit::metre ? "metres" : unit == Unit::centimetre ? "centimetres" : "millimetres";
}

std::optional<Unit> unit_of(const std::string &name) {
  for (const Unit unit : all_units)
    if (name == name_of(unit)) return unit;
  return std::nullopt;
}

double factor_between(Unit from, Unit to) { return millimetres_of(from) / millimetres_of(to); }

double paper_half_thickness(Unit unit) { return 1 / millimetres_of(unit); }

std::optional<Unit> unit_reached(Unit from, double factor) {
  for (const Unit to : all_units)
    if (is_about(factor, factor_between(from, to))) return to;
  return std::nullopt;
}

std::optional<UnitPair> units_of_factor(double factor) {
  for (const Unit surface : all_units)
    for (const Unit mesh : all_units)
      if (surface != mesh && is_about(factor, factor_between(surface, mesh))) return UnitPair{surface, mesh};
  return std::nullopt;
}

std::optional<Unit> unit_of_valve(double largest_side) {
  for (const Unit unit : all_units) {
    const double centimetres = largest_side * factor_between(unit, Unit::centimetre);
    if (centimetres >= 1.2 && centimetres < 12) return unit;
  }
  return std::nullopt;
}

namespace {

// A mesh fits its valve under three conditions. Its size is 0.5 to 40 times the valve's size. Its edges are at most 0.3 times
// the valve's size. The two boxes overlap.
constexpr double smallest_mesh = 0.5, usual_mesh = 3, longest_edge = 0.3;
// The least half thickness, as a share of the mesh's edge length. A thinner band falls between two layers of nodes and contains
// few nodes.
constexpr double smallest_half_thickness = 0.3;

constexpr std::array<double, 6> factors = {0.1, 10, 0.01, 100, 0.001, 1000};

// Returns whether the boxes overlap if the surface is scaled by 1 / factor. The translation is not scaled, because it is in the
// mesh's unit.
bool overlap_at(double factor, const Sizes &s) {
  for (int k = 0; k < 3; ++k) {
    const double shift = s.translation[k];
    const double lower = (s.surface.lower[k] - shift) / factor + shift,
                 upper = (s.surface.upper[k] - shift) / factor + shift;
    if (upper < s.mesh.lower[k] || lower > s.mesh.upper[k]) return false;
  }
  return true;
}

double mesh_in_surfaces(const Sizes &s) { return s.mesh.largest_side() / s.surface.largest_side(); }

// Returns whether the edges suit the default half thickness, which belongs to a parametric valve. If they are much longer, the
// mesh probably has another unit. But if the user named the unit, the mesh is only coarse.
bool edges_fit_at(double factor, const Sizes &s) {
  return !s.has_usual_half || s.is_unit_known || !is_too_small(s.half_thickness / factor, s);
}

}  // namespace

bool is_too_large(double half_thickness, const Sizes &s) {
  return half_thickness > largest_half_thickness * s.surface.largest_side();
}

bool is_too_small(double half_thickness, const Sizes &s) {
  return half_thickness < smallest_half_thickness * s.median_edge;
}

bool sizes_fit_at(double factor, const Sizes &s) {
  const double ratio = factor * mesh_in_surfaces(s);
  return ratio >= smallest_mesh && ratio <= largest_mesh &&
         factor * s.median_edge <= longest_edge * s.surface.largest_side();
}

std::optional<double> missing_factor(const Sizes &s) {
  const bool sizes_fit = sizes_fit_at(1, s), is_sure = s.is_unit_known || mesh_in_surfaces(s) <= s.most_sure;
  if (sizes_fit && edges_fit_at(1, s) && is_sure) {
    // The unit is right in two cases: if the sizes are similar, or if they fit in units that the user named. Then only the
    // position can be wrong.
    const bool are_alike = mesh_in_surfaces(s) > 1.0 / 3 && mesh_in_surfaces(s) < 3;
    if (overlap_at(1, s) || are_alike || s.is_unit_known) return std::nullopt;
  }
  // Sizes that differ this much must have different units, even if no factor brings the positions together.
  const bool differ_widely = mesh_in_surfaces(s) < 0.1 || mesh_in_surfaces(s) > 100;
  std::optional<double> best;
  // The passes become less strict. The last ones accept a mesh that is in another unit and also too coarse.
  struct Pass {
    bool must_overlap, must_resolve;
  };
  for (const auto [must_overlap, must_resolve] :
       {Pass{true, true}, Pass{false, true}, Pass{true, false}, Pass{false, false}}) {
    if (best || (!must_overlap && !differ_widely) || (!must_resolve && sizes_fit)) continue;
    double least = std::numeric_limits<double>::infinity();
    for (const double factor : factors) {
      if (!sizes_fit_at(factor, s) || (must_resolve && !edges_fit_at(factor, s)) ||
          (must_overlap && !overlap_at(factor, s)))
        continue;
      const double oddity = std::abs(std::log(factor * mesh_in_surfaces(s) / usual_mesh));
      if (oddity < least) {
        least = oddity;
        best = factor;
      }
    }
  }
  return best;
}

Sizes rescaled(const Sizes &s, double factor) {
  Sizes changed = s;
  for (int k = 0; k < 3; ++k) {
    changed.surface.lower[k] /= factor;
    changed.surface.upper[k] /= factor;
  }
  return changed;
}

double better_half_thickness(const Sizes &s) {
  const auto fits = [&](double half_thickness) {
    return !is_too_large(half_thickness, s) && !is_too_small(half_thickness, s);
  };
  const double usual = usual_half_thickness * s.surface.largest_side();
  double best = 0;
  for (const double factor : factors) {
    const double candidate = s.half_thickness * factor;
    if (!fits(candidate)) continue;
    if (best == 0 || std::abs(std::log(candidate / usual)) < std::abs(std::log(best / usual))) best = candidate;
  }
  if (best != 0) return best;
  return s.median_edge > 0 && fits(s.median_edge) ? s.median_edge : 0;
}

}  // namespace riis::program
