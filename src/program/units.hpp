// SPDX-License-Identifier: Apache-2.0
// Units of length, as --unit and --surface-unit name them.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace riis::program {

enum class Unit { metre, centimetre, millimetre };

// Units as an option has them, "m", and in words, "metres".
const std::vector<std::string> &unit_names();
const char *name_of(Unit unit);
const char *words_of(Unit unit);
// Returns the unit of one of unit_names(), or none for "".
std::optional<Unit> unit_of(const std::string &name);

// Returns the factor from one unit to the other: 0.01 from centimetres to metres.
double factor_between(Unit from, Unit to);
// Returns the paper's half thickness, 0.1 cm, in that unit.
double paper_half_thickness(Unit unit);

// Returns the unit to which the factor leads from a unit, or none.
std::optional<Unit> unit_reached(Unit from, double factor);
// The pair of units, surface and mesh, for a factor from one to the other. None for other factors and for 1.
struct UnitPair {
  Unit surface, mesh;
};
std::optional<UnitPair> units_of_factor(double factor);
// Returns the unit in which a heart valve has this size, 1 to 10 centimetres or so.
std::optional<Unit> unit_of_valve(double largest_side);

}  // namespace riis::program
