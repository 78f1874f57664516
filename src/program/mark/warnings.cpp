// SPDX-License-Identifier: Apache-2.0
#include "program/mark/warnings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "common/elementary.hpp"
#include "common/number_from_chars.hpp"
#include "program/base/handles.hpp"
#include "program/base/ranks.hpp"
#include "program/base/text.hpp"
#include "program/commands/commands.hpp"
#include "program/input/valve_file.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/mesh_pieces.hpp"
#include "program/output/report.hpp"

namespace riis::program {

namespace {

std::int64_t n_printed = 0;
Cause first_cause = Cause::outside;  // the cause whose advice was printed

// Smaller meshes are not judged, because all nodes of a small mesh may lie near the surface.
constexpr int64_t fewest_judged_nodes = 100;

// Returns a coordinate as text, rounded to a tenth of the edge or finer. The text has no trailing zeros, and 0 has no sign.
std::string coordinate_text(double x, double edge) {
  constexpr int most_digits = 17;  // the most digits of a double
  if (x == 0) return "0";
  const int n_digits = edge > 0 ? decimal_exponent(x) - decimal_exponent(edge) + 2 : 6;
  if (n_digits < 1) return "0";
  char text[32];
  const int precision = std::min(n_digits, most_digits);
  double rounded = 0;
  const char *end = std::to_chars(text, text + sizeof text, x, std::chars_format::scientific, precision - 1).ptr;
  number_from_chars(text, end, rounded);
  const bool is_usual = std::abs(rounded) >= 1e-9 && std::abs(rounded) < 1e15;
  const auto form = is_usual ? std::chars_format::fixed : std::chars_format::scientific;
  return {text, std::to_chars(text, text + sizeof text, rounded, form).ptr};
}

std::string text_of(const Box &box, double edge) {
  std::string text;
  for (int k = 0; k < 3; ++k) {
    text += std::string(k == 0 ? "" : ", ") + "xyz"[k] + " " + coordinate_text(box.lower[k], edge) + " to " +
            coordinate_text(box.upper[k], edge);
  }
  return text;
}

bool is_parametric(const MarkOptions &options) { return options.surface.empty() && !is_valve_file(options.valve); }

// Returns whether the surface has the size of a valve. For a file whose unit is not known, returns false.
bool has_size_of_valve(const Situation &s) {
  const std::optional<Unit> own = s.options.surface_unit;
  if (is_parametric(s.options)) return true;
  return own && unit_of_valve(s.surface.largest_side() / s.options.surface_options.scale) == own;
}

bool has_all(const Situation &s) { return s.n_marked == s.n_nodes && s.n_nodes >= fewest_judged_nodes; }

// Returns whether suspiciously few nodes are marked. A single layer of nodes on the surface would have about area / edge^2 nodes.
bool has_hardly_any(const Situation &s) {
  if (s.n_marked == 0 || s.n_nodes < fewest_judged_nodes || s.median_edge == 0) return false;
  return static_cast<double>(s.n_marked) * s.median_edge * s.median_edge < 0.1 * s.area;
}

bool has_odd_half_thickness(const Situation &s) {
  return s.n_nodes >= fewest_judged_nodes && (is_too_large(s.half_thickness, s) || is_too_small(s.half_thickness, s));
}

std::string marked_text(const Situation &s) {
  if (s.n_marked == 0) return "no node is marked";
  if (has_all(s)) return "all " + counted(s.n_nodes, "node") + " are marked";
  const std::string text =
      grouped(s.n_marked) + " of " + counted(s.n_nodes, "node") + (s.n_marked == 1 ? " is marked" : " are marked");
  return has_hardly_any(s) ? "only " + text : text + ", which looks wrong";
}

// Returns a warning with the positions of the mesh and the surface, for marks that the sizes do not explain.
Warning warning_of_places(const Situation &s) {
  return {Cause::place,
          "the mesh is in " + text_of(s.mesh, s.median_edge) + ", the surface in " + text_of(s.surface, s.median_edge) +
              ", the half thickness is " + shown(s.half_thickness),
          ": see --translate, --rotate, --scale, --half-thickness"};
}

// ---- Advice ----

std::string option(const char *name, Unit unit) { return std::string(name) + " " + name_of(unit); }

// The units of a mesh and of a surface, and the options that the user should write for them. If the units are not known, the
// scale is only a factor.
struct Cure {
  std::optional<UnitPair> units;
  std::string write;
};

Cure cure_for_scale(const Situation &s, double scale) {
  const MarkOptions &options = s.options;
  const std::optional<Unit> own = is_parametric(options) ? Unit::centimetre : options.surface_unit;
  const auto mesh = own ? unit_reached(*own, scale) : std::nullopt;
  std::optional<UnitPair> pair;
  if (mesh)
    pair = UnitPair{*own, *mesh};
  else if (!is_parametric(options))
    pair = units_of_factor(scale);
  if (!pair && !own && scale == 1)
    if (const auto both = unit_of_valve(s.surface.largest_side())) pair = UnitPair{*both, *both};
  if (!pair) return {std::nullopt, "--scale " + shown(scale)};
  const std::string of_surface = is_parametric(options) ? "" : " " + option("--surface-unit", pair->surface);
  return {pair, option("--unit", pair->mesh) + of_surface};
}

// Returns the factors of the units that the mesh may have. Returns all factors if the present scale belongs to no pair of units.
std::vector<double> factors_of_units(const Situation &s) {
  std::vector<double> found;
  for (const double factor : unit_factors())
    if (cure_for_scale(s, s.options.surface_options.scale / factor).units) found.push_back(factor);
  return found.empty() ? unit_factors() : found;
}

// Judges the units. The length of edges near the surface is estimated from the number n of marked nodes. The estimate is the edge
// of n equal cubes that fill the band together.
UnitJudgement judgement_of(const Situation &s, bool is_unit_known) {
  Sizes sizes = s;
  sizes.is_unit_known = is_unit_known;
  if (s.n_marked > 0) sizes.near_edge = cube_root(2 * s.half_thickness * s.area / static_cast<double>(s.n_marked));
  return judge_units(sizes, factors_of_units(s));
}

std::string text_of_units(const Situation &s, const std::vector<Cure> &cures) {
  std::vector<std::string> meshes;
  for (const Cure &cure : cures)
    if (cure.units) meshes.emplace_back(words_of(cure.units->mesh));
  if (meshes.size() < cures.size()) return "the mesh and the surface look as if they were in different units";
  // The sides that stand beside this text have the present scale, which the user's options may have chosen.
  const Unit own = cures.front().units->surface;
  const Unit present = unit_reached(own, s.options.surface_options.scale).value_or(own);
  return "the mesh looks as if it were in " + joined_by(meshes, " or ") + ", the surface in " + words_of(present);
}

// Returns the user's options for the scale, which other options must replace.
std::string in_place_of(const MarkOptions &options) {
  if (options.unit && !options.takes_placed_unit) {
    const std::string unit = " in place of " + option("--unit", *options.unit);
    return options.surface_unit ? unit + " " + option("--surface-unit", *options.surface_unit) : unit;
  }
  return options.has_scale ? " in place of --scale " + shown(options.surface_options.scale) : "";
}

// Returns an option with a half thickness that suits another unit. Returns "" if the user's half thickness suits the other unit.
std::string half_thickness_at(double factor, const Situation &s) {
  if (!s.options.has_half_thickness) return "";
  const Sizes cured = rescaled(s, factor);
  if (!is_too_large(s.half_thickness, cured) && !is_too_small(s.half_thickness, cured)) return "";
  const double better = better_half_thickness(cured);
  return better > 0 ? " --half-thickness " + shown(better) : "";
}

std::string sides_text(const Box &box) {
  std::vector<std::string> sides;
  for (int k = 0; k < 3; ++k) sides.push_back(shown(box.upper[k] - box.lower[k]));
  return joined_by(sides, " x ");
}

// Returns a warning if the sizes suggest other units than the present units. The warning names each possible unit and the options
// to write, such as "the mesh looks as if it were in metres, ...: write --unit m".
std::optional<Warning> warning_of_units(const Situation &s) {
  const UnitJudgement units = judgement_of(s, s.is_unit_known);
  const bool is_same = units.factors == std::vector<double>{1};
  if (units.is_right || units.factors.empty() || is_same || (s.is_unit_known && units.is_possible(1)))
    return std::nullopt;
  std::vector<Cure> cures;
  std::vector<std::string> write;
  for (const double factor : units.factors) {
    // Scales that belong to no unit are too many to be named one by one.
    if (!cures.empty() && !cures.front().units) break;
    cures.push_back(cure_for_scale(s, s.options.surface_options.scale / factor));
    write.push_back(cures.back().write + half_thickness_at(factor, s));
  }
  return Warning{Cause::units,
                 text_of_units(s, cures) + " (sides " + sides_text(s.mesh) + " and " + sides_text(s.surface) + ")",
                 ": write " + joined_by(write, " or ") + in_place_of(s.options)};
}

// Returns a warning if the half thickness is too large or too small. The warning also names the option that the user should
// write.
std::optional<Warning> warning_of_half_thickness(const Situation &s) {
  const bool is_large = is_too_large(s.half_thickness, s);
  if (!is_large && !is_too_small(s.half_thickness, s)) return std::nullopt;
  Warning warning{Cause::half_thickness, "the half thickness is " + shown(s.half_thickness), ""};
  warning.text += is_large ? ", the largest side of the surface " + shown(s.surface.largest_side())
                           : ", the median edge of the mesh " + shown(s.median_edge);
  // If the user named no unit, the unit is unknown, and the half thickness is the default for centimetres.
  const bool is_unknown =
      !is_parametric(s.options) && !s.options.unit && !s.options.has_scale && !s.options.has_half_thickness;
  const auto unit = is_unknown ? unit_of_valve(s.surface.largest_side()) : std::nullopt;
  if (unit && !is_too_large(paper_half_thickness(*unit), s) && !is_too_small(paper_half_thickness(*unit), s)) {
    warning.text += ", and both look as if they were in " + std::string(words_of(*unit));
    warning.advice = ": write " + option("--unit", *unit) + " " + option("--surface-unit", *unit);
    return warning;
  }
  const double better = better_half_thickness(s);
  warning.advice = better > 0 ? ": write --half-thickness " + shown(better)
                   : is_large ? ": see --half-thickness, --scale"
                              : ": the mesh is too coarse for this surface";
  return warning;
}

}  // namespace

std::string shown(double number) { return printed("%.3g", number); }

Situation::Situation(const MarkOptions &marking, const riis_surface_info &info, const MeshCounts &counts)
    : Sizes{sides_of(counts.box, counts.moments), box_of(info), counts.median_edge, info.half_thickness},
      options(marking),
      mesh(counts.box),
      area(info.area) {
  is_unit_known = (options.unit && !options.takes_placed_unit) || options.has_scale;
  has_usual_half = is_parametric(options) && !options.has_half_thickness;
  const double usual = options.placed_unit ? factor_between(Unit::centimetre, *options.placed_unit) : 1;
  unnamed_factor = options.surface_options.scale / usual;
}

std::optional<Warning> warning_of(const Situation &s) {
  const bool has_none = s.n_marked == 0 && !s.options.allow_none;
  const bool are_odd = has_none || has_all(s) || has_hardly_any(s) || has_odd_half_thickness(s);
  // The size of a valve is known, so a wrong unit is noticed even if the marks look right.
  const bool has_size = is_parametric(s.options) && s.n_nodes >= fewest_judged_nodes && s.n_marked > 0;
  std::optional<Warning> why = are_odd || has_size ? warning_of_units(s) : std::nullopt;
  if (!why && !are_odd) return std::nullopt;
  if (!why) why = warning_of_half_thickness(s);
  if (!why) why = warning_of_places(s);
  why->text = marked_text(s) + ": " + why->text;
  return why;
}

std::optional<Warning> warning_of_thickness(const MarkOptions &options, const riis_surface_info &info) {
  return warning_of_half_thickness(Situation(options, info, MeshCounts()));
}

std::vector<PossibleUnit> units_left_open(const Situation &s) {
  const double present = s.options.surface_options.scale;
  if (!s.is_unit_known || !has_size_of_valve(s) || is_as_wide(s, s.unnamed_factor) || warning_of_units(s)) return {};
  const UnitJudgement unnamed = judgement_of(s, false);
  if (s.unnamed_factor == 1 && unnamed.is_right) return {};
  std::vector<double> factors = unnamed.factors;
  factors.erase(std::remove(factors.begin(), factors.end(), 1), factors.end());
  if (factors.empty()) return {};
  factors.insert(factors.begin(), 1);
  std::vector<PossibleUnit> open;
  for (const double factor : factors) {
    const double half_thickness = s.options.has_half_thickness ? s.half_thickness : s.half_thickness / factor;
    open.push_back({cure_for_scale(s, present / factor).write, present / factor, half_thickness,
                    s.options.placed_unit ? 1 / factor : 1});
  }
  return open;
}

void print_line(const std::string &text) {
  if (ranks::is_first()) std::fprintf(stderr, "riis: %s\n", text.c_str());
}

void warn(const std::string &text) {
  ++n_printed;
  print_line(text);
}

void warn(std::vector<Warning> warnings) {
  std::stable_sort(warnings.begin(), warnings.end(),
                   [](const Warning &a, const Warning &b) { return a.cause < b.cause; });
  for (const Warning &warning : warnings) {
    const bool is_first = warning.cause <= first_cause;
    if (is_first) first_cause = warning.cause;
    warn(is_first ? warning.text + warning.advice : warning.text);
  }
}

std::int64_t n_warnings() { return n_printed; }

std::string place_text(const ValveOptions &options, const double *point, double edge) {
  std::string text;
  for (int k = 0; k < 3; ++k) text += (k == 0 ? "" : " ") + coordinate_text(point[k], edge);
  return options.unit && !options.has_doubted_unit ? text + " " + name_of(*options.unit) : text;
}

// ---- The gap of bumps ----

namespace {

// Areas count only above a small share of the outline's area, because the triangles are coarse. The area that the bands leave is
// mostly 0, so its error is smaller.
constexpr double least_share = 1e-3, least_share_left = 1e-5;
// The width of the gap is found by halving. Its error is a small share of the width that two bands bridge.
constexpr int n_halvings = 10;

// Removes all bumps from the valve. Returns whether the valve had a bump with a place.
bool remove_bumps(riis_valve *valve) {
  bool has_bump = false;
  for (const riis_parameter &parameter : all_parameters(valve)) {
    const std::string name = parameter.name;
    const bool is_place =
        name.rfind("bump_", 0) == 0 && (has_ending(name, ".leaflet") || has_ending(name, ".commissure"));
    if (!is_place || values_of(valve, parameter)[0] == parameter.default_values[0]) continue;
    check(riis_valve_unset(valve, parameter.name));
    has_bump = true;
  }
  return has_bump;
}

// Returns the closed valve with a band without offset, or null if the valve cannot close.
Surface closed_surface(const ValveOptions &options, riis_valve *valve) {
  riis_surface_options how = own_frame(options);
  how.offset = 0;
  how.measure = RIIS_MEASURE_TRIANGLES;
  how.measure_tolerance = RIIS_AUTO;
  how.triangulation = RIIS_TRIANGULATION_ADAPTED;
  return surface_at(valve, 0, how);
}

// Returns the orifice of a surface. The effective area of the orifice is the area that remains after the edge of the orifice
// moves inwards along the leaflets.
riis_orifice orifice_of(const riis_surface *surface, double moved, double rim_reach) {
  auto resistance = defaults<riis_resistance>();
  resistance.half_thickness = moved / rim_reach;
  return get<riis_orifice>(riis_surface_get_orifice, surface, &resistance);
}

}  // namespace

void warn_of_bridged_gap(const ValveOptions &options, const riis_valve *valve, const std::string &part) {
  const Valve healthy = copy_of(valve);
  if (!remove_bumps(healthy)) return;
  const Valve sick = copy_of(valve);
  const Surface with_gap = closed_surface(options, sick), without_gap = closed_surface(options, healthy);
  if (!with_gap || !without_gap) return;
  const double bridged = 1 - options.surface_options.offset;  // in half thicknesses, on either side of the gap
  const double reach = bridged * info_of(with_gap).half_thickness;
  // A rim's band reaches inwards by a share of the half thickness. The share is equal for all half thicknesses.
  const auto resistance = defaults<riis_resistance>();
  const double rim_reach = get<riis_orifice>(riis_surface_get_orifice, with_gap, &resistance).rim_reach;
  const riis_orifice whole = orifice_of(with_gap, reach, rim_reach), usual = orifice_of(without_gap, reach, rim_reach);
  const double gap = whole.area - usual.area, least_left = least_share_left * usual.outline_area;
  if (gap <= least_share * usual.outline_area || whole.effective_area - usual.effective_area > least_left) return;
  double open = 0, closed = reach;
  for (int i = 0; i < n_halvings; ++i) {
    const double middle = 0.5 * (open + closed);
    const double left = orifice_of(with_gap, middle, rim_reach).effective_area;
    const bool is_wider =
        left > least_left && left - orifice_of(without_gap, middle, rim_reach).effective_area > least_left;
    (is_wider ? open : closed) = middle;
  }
  warn((part.empty() ? "" : part + ": ") + "bumps leave a gap of " + shown(gap) +
       " in the closed valve, which is at most " + shown(2 * closed) + " wide, and the band closes gaps of up to " +
       shown(2 * reach) + ", " + shown(2 * bridged) + " half thicknesses; a half thickness below " +
       shown(closed / bridged) + " leaves it open");
}

}  // namespace riis::program
