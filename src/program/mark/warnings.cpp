// SPDX-License-Identifier: Apache-2.0
#include "program/mark/warnings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "program/base/ranks.hpp"
#include "program/input/valve_file.hpp"
#include "program/output/report.hpp"

namespace riis::program {

namespace {

std::int64_t n_printed = 0;
Cause first_cause = Cause::outside;  // the cause whose advice was printed

// Smaller meshes are not judged, because all nodes of a small mesh may well lie near the surface.
constexpr int64_t fewest_judged_nodes = 100;

// Returns a coordinate as text, rounded to a tenth of the edge or finer. It has no trailing zeros, and 0 has no sign.
std::string coordinate_text(double x, double edge) {
  constexpr int most_digits = 17;  // the most digits of a double
  int n_digits = 6;
  if (edge > 0) n_digits = static_cast<int>(std::floor(std::log10(std::abs(x))) - std::floor(std::log10(edge)) + 2);
  if (x == 0 || n_digits < 1) return "0";
  char text[32];
  const int precision = std::min(n_digits, most_digits);
  double rounded = 0;
  const char *end = std::to_chars(text, text + sizeof text, x, std::chars_format::scientific, precision - 1).ptr;
  std::from_chars(text, end, rounded);
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

bool has_all(const Situation &s) { return s.n_marked == s.n_nodes && s.n_nodes >= fewest_judged_nodes; }

// Returns whether suspiciously few nodes are marked. A single layer of nodes on the surface would have about area / edge^2
// nodes.
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

// Returns a warning that names the positions of mesh and surface. It is used if sizes do not explain the marks.
Warning warning_of_places(const Situation &s) {
  return {Cause::place,
          "the mesh is in " + text_of(s.mesh, s.median_edge) + ", the surface in " + text_of(s.surface, s.median_edge) +
              ", the half thickness is " + shown(s.half_thickness),
          ": see --translate, --rotate, --scale, --half-thickness"};
}

// ---- Advice ----

std::string option(const char *name, Unit unit) { return std::string(name) + " " + name_of(unit); }

// Two phrases for a warning: the unit that the sizes suggest, and the options to write.
struct Cure {
  std::string look, write;
};

std::string look_of(Unit mesh, Unit surface) {
  if (mesh == surface) return std::string("the mesh looks as if it were in ") + words_of(mesh) + ", as the surface is";
  return std::string("the mesh looks as if it were in ") + words_of(mesh) + ", the surface in " + words_of(surface);
}

Cure cure_for_scale(const MarkOptions &options, double scale) {
  if (is_parametric(options)) {
    if (const auto mesh = unit_reached(Unit::centimetre, scale)) {
      return {look_of(*mesh, Unit::centimetre), option("--unit", *mesh)};
    }
  } else {
    const auto mesh = options.surface_unit ? unit_reached(*options.surface_unit, scale) : std::nullopt;
    const auto pair = mesh ? UnitPair{*options.surface_unit, *mesh} : units_of_factor(scale);
    if (pair) {
      return {look_of(pair->mesh, pair->surface),
              option("--unit", pair->mesh) + " " + option("--surface-unit", pair->surface)};
    }
  }
  return {"the mesh and the surface look as if they were in different units", "--scale " + shown(scale)};
}

// Returns the user's own options for the scale, which the user must replace.
std::string in_place_of(const MarkOptions &options) {
  if (options.unit) {
    const std::string unit = " in place of " + option("--unit", *options.unit);
    return options.surface_unit ? unit + " " + option("--surface-unit", *options.surface_unit) : unit;
  }
  return options.has_scale ? " in place of --scale " + shown(options.surface_options.scale) : "";
}

// Returns a warning if the sizes suggest different units for the mesh and the surface. It names these units and the options to
// write, such as "the mesh looks as if it were in metres, ...: write --unit m".
std::optional<Warning> warning_of_units(const Situation &s) {
  const auto factor = missing_factor(s);
  if (!factor) return std::nullopt;
  const Cure cure = cure_for_scale(s.options, s.options.surface_options.scale / *factor);
  std::string write = cure.write;
  if (s.options.has_half_thickness) {
    const Sizes cured = rescaled(s, *factor);
    if (is_too_large(s.half_thickness, cured) || is_too_small(s.half_thickness, cured)) {
      const double better = better_half_thickness(cured);
      if (better > 0) write += " --half-thickness " + shown(better);
    }
  }
  return Warning{
      Cause::units,
      cure.look + " (largest sides " + shown(s.mesh.largest_side()) + " and " + shown(s.surface.largest_side()) + ")",
      ": write " + write + in_place_of(s.options)};
}

// Returns a warning if the half thickness is too large or too small. It names the option to write.
std::optional<Warning> warning_of_half_thickness(const Situation &s) {
  const bool is_large = is_too_large(s.half_thickness, s);
  if (!is_large && !is_too_small(s.half_thickness, s)) return std::nullopt;
  Warning warning{Cause::half_thickness, "the half thickness is " + shown(s.half_thickness), ""};
  warning.text += is_large ? ", the largest side of the surface " + shown(s.surface.largest_side())
                           : ", the median edge of the mesh " + shown(s.median_edge);
  // The unit is unknown if the user named none. The half thickness is then the default for centimetres.
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

Situation::Situation(const MarkOptions &marking, const riis_surface_info &info, const Box &mesh_box,
                     double median_edge_of_mesh)
    : Sizes{mesh_box, {}, median_edge_of_mesh, info.half_thickness}, options(marking), area(info.area) {
  std::copy_n(info.lower, 3, surface.lower);
  std::copy_n(info.upper, 3, surface.upper);
  std::copy_n(options.surface_options.translation, 3, translation);
  is_unit_known = options.unit || options.has_scale;
  has_usual_half = is_parametric(options) && !options.has_half_thickness;
}

std::optional<Warning> warning_of(const Situation &s) {
  const bool has_none = s.n_marked == 0 && !s.options.allow_none;
  if (!has_none && !has_all(s) && !has_hardly_any(s) && !has_odd_half_thickness(s)) return std::nullopt;
  std::optional<Warning> why = warning_of_units(s);
  if (!why) why = warning_of_half_thickness(s);
  if (!why) why = warning_of_places(s);
  why->text = marked_text(s) + ": " + why->text;
  return why;
}

void warn(const std::string &text) {
  ++n_printed;
  if (ranks::is_first()) std::fprintf(stderr, "riis: %s\n", text.c_str());
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
  return options.unit ? text + " " + name_of(*options.unit) : text;
}

}  // namespace riis::program
