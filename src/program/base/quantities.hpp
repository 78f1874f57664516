// SPDX-License-Identifier: Apache-2.0
// Quantities of the flow, such as R, and their units (docs/program.md, "Units of R").
// The input is a number as the user wrote it, perhaps with a unit. The result is the number in the units of a mesh, and the names
// of units.
//
// The unit of mass is the kilogram for a mesh in metres, and the gram for a mesh in centimetres or millimetres. A number without
// a unit is in SI units if the mesh's unit of length is known. Otherwise such a number is in the mesh's units, and a number with
// a unit is refused.
#pragma once

#include <optional>
#include <string>

#include "program/base/refusal.hpp"
#include "program/base/units.hpp"

namespace riis::program {

struct Quantity {
  const char *words;       // with an article
  const char *si;          // the name of its SI unit
  int mass, length, time;  // the exponents of its unit
};

inline constexpr Quantity a_resistance = {"a resistance", "kg/(m s)", 1, -1, -1};
inline constexpr Quantity a_density = {"a density", "kg/m3", 1, -3, 0};
inline constexpr Quantity a_viscosity = {"a viscosity", "Pa s", 1, -1, -1};
inline constexpr Quantity a_pressure = {"a pressure", "Pa", 1, -1, -2};
inline constexpr Quantity a_length = {"a length", "m", 0, 1, 0};
inline constexpr Quantity an_area = {"an area", "m2", 0, 2, 0};
inline constexpr Quantity a_flow = {"a flow", "m3/s", 0, 3, -1};
inline constexpr Quantity a_K = {"a K", "kg/(m3 s)", 1, -3, -1};
inline constexpr Quantity a_K_u_surface = {"a K u_surface", "kg/(m2 s2)", 1, -2, -2};

// A number with the text that the user wrote.
struct Amount {
  double number = 0;                      // in SI units if the text has a unit
  bool has_unit = false;                  // whether the text has a unit
  std::string text;                       // as the user wrote it
  std::string subject;                    // such as "--resistance", for refusals
  ExitCode exit_code = exit_wrong_usage;  // the status of a refusal
};

// Reads a text such as "1e4" or "1e5 g/(cm s)". Refuses a unit that does not belong to the quantity.
Amount parse_amount(const std::string &text, const std::string &subject, const Quantity &quantity);

// Returns the SI value of a unit such as "kg/(m3 s)". Refuses a text that is not a unit of the quantity.
double parse_unit_of(const std::string &text, const std::string &subject, const Quantity &quantity);

// Returns the factor from SI units to the units of a mesh. For example, the factor is 10 for R in a mesh in centimetres.
double factor_from_si(const Quantity &quantity, Unit unit);

// Returns the number in the units of the mesh. Refuses a number with a unit if the unit of the mesh is not known.
double in_mesh_units(const Amount &amount, const Quantity &quantity, std::optional<Unit> unit);

// Returns the name of the quantity's unit in a mesh, such as "g/(cm s)".
std::string unit_text(const Quantity &quantity, Unit unit);

}  // namespace riis::program
