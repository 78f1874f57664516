// SPDX-License-Identifier: Apache-2.0
// Prints and counts all warnings of the program. The texts of warnings about leaks are in leaks.cpp.
// The inputs are the number of marks, and all sizes. The results are lines that name the suspicious values and the options to
// write instead.
#pragma once

#include <riis/riis_vtk.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/base/options.hpp"
#include "program/base/units.hpp"

namespace riis::program {

struct MeshCounts;

// The result of a marking with the sizes of the mesh and the surface, in the mesh's unit.
struct Situation : Sizes {
  Situation(const MarkOptions &marking, const riis_surface_info &info, const MeshCounts &counts);

  const MarkOptions &options;
  Box mesh;
  double area;  // of the surface
  int64_t n_nodes = 0, n_marked = 0;
};

// The possible causes of wrong marks, in the order in which the user should correct them. A wrong unit also makes the half
// thickness wrong. A wrong unit or a wrong half thickness can cause leaks, or can put a part of the leaflets outside the mesh.
enum class Cause { units, half_thickness, place, leaks, outside };

// The text of a warning and its advice, without line breaks. The advice begins with the punctuation that follows the text, as in
// ": write --unit m".
struct Warning {
  Cause cause;
  std::string text, advice;
};

// Returns a warning, or nothing if the marks look right.
std::optional<Warning> warning_of(const Situation &situation);

// Returns a warning if the half thickness is too large for a surface. The function needs no mesh.
std::optional<Warning> warning_of_thickness(const MarkOptions &options, const riis_surface_info &info);

// A unit that a mesh may have, with the options that the user writes for it, the placement, and the half thickness.
struct PossibleUnit {
  std::string write;
  double scale, half_thickness;
  double placement;  // the factor of the placement's lengths
};

// If the user named a unit, returns the units that the mesh may have, or none if only the named unit is possible. The present
// unit comes first. A run without a unit advises the same units.
std::vector<PossibleUnit> units_left_open(const Situation &situation);

// The first rank prints the line on stderr.
void print_line(const std::string &text);
// Prints a warning, and counts it for --strict. --quiet does not silence a warning, because wrong marks look like right ones.
void warn(const std::string &text);
// Prints the texts of all warnings, but only the advice for the first cause. Later calls leave out the advice for later causes.
// The first advice may correct all causes, and a second advice could contradict it.
void warn(std::vector<Warning> warnings);
std::int64_t n_warnings();

// Returns a position as text for a warning. If the user named a unit, the text includes the unit. Coordinates are rounded to a
// tenth of the edge's length or finer, so the texts of the edge's two ends differ. If the given length is 0, coordinates have six
// digits.
std::string place_text(const ValveOptions &options, const double *point, double edge);

// Returns the text of a number as a user would write it.
std::string shown(double number);

// Warns if bumps (docs/theory/bumps.md) leave a gap in the closed valve that is nowhere wider than the two bands beside it can
// bridge. The gap is measured in the orifice, as seen along its axis. Slits that the valve has without bumps do not count. The
// warning begins with `part`.
void warn_of_bridged_gap(const ValveOptions &options, const riis_valve *valve, const std::string &part);

}  // namespace riis::program
