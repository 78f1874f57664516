// SPDX-License-Identifier: Apache-2.0
// The units of length of --unit and --surface-unit.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace riis::program {

enum class Unit { metre, centimetre, millimetre };

// Return the names in options, such as "m", and in words, such as "metres".
const std::vector<std::string> &unit_names();
const char *name_of(Unit unit);
const char *words_of(Unit unit);
// Returns the unit of one of unit_names(), or none for "".
std::optional<Unit> unit_of(const std::string &name);

// Returns the factor from one unit to the other: 0.01 from centimetres to metres.
double factor_between(Unit from, Unit to);
// Returns the paper's half thickness, 0.1 cm, in that unit.
double paper_half_thickness(Unit unit);

// Returns the unit that is the given unit times the factor, or none.
std::optional<Unit> unit_reached(Unit from, double factor);
// Returns the pair of units, surface and mesh, that the factor relates. Returns none for other factors and for 1.
struct UnitPair {
  Unit surface, mesh;
};
std::optional<UnitPair> units_of_factor(double factor);
// Returns the unit in which this size is a heart valve's, about 1 to 10 centimetres.
std::optional<Unit> unit_of_valve(double largest_side);

}  // namespace riis::program
