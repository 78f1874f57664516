// SPDX-License-Identifier: Apache-2.0
// The units of length that --unit and --surface-unit accept.
#pragma once

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

}  // namespace riis::program
