// SPDX-License-Identifier: Apache-2.0
#include "program/base/units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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

}  // namespace riis::program
