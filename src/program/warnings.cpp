// SPDX-License-Identifier: Apache-2.0
#include "program/warnings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "program/ranks.hpp"
#include "program/refusal.hpp"
#include "program/report.hpp"
#include "program/valve_file.hpp"

namespace riis::program {

namespace {

std::int64_t n_printed = 0;
Cause first_cause = Cause::leaks;  // the cause whose advice was printed

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

bool has_all(const Situation &s) { return s.n_marked == s.n_nodes && s.n_nodes >= fewest_judged_nodes; }

// Returns whether suspiciously few nodes are marked. A single layer of nodes over the surface would have about area / edge^2
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

}  // namespace

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

// ---- Advice ----

namespace {

// A mesh fits its valve under three conditions. Its size is 0.5 to 40 times the valve's size. Its edges are at most 0.3 times
// the valve's size. The two boxes overlap.
constexpr double smallest_mesh = 0.5, largest_mesh = 40, usual_mesh = 3, longest_edge = 0.3;
// Both limits of the half thickness are shares of the surface's largest side. The paper's half thickness, 0.1 cm, is 0.04 of the
// largest side of its aortic valve.
constexpr double usual_half_thickness = 0.04, largest_half_thickness = 0.25;
// The least half thickness, as a share of the mesh's edge length. A thinner band falls between two layers of nodes and contains
// few nodes.
constexpr double smallest_half_thickness = 0.3;

constexpr std::array<double, 6> factors = {0.1, 10, 0.01, 100, 0.001, 1000};

// Returns whether the boxes overlap if the surface is scaled by 1 / factor. The translation is not scaled, because it is in the
// mesh's unit.
bool overlap_at(double factor, const Situation &s) {
  for (int k = 0; k < 3; ++k) {
    const double shift = s.options.surface_options.translation[k];
    const double lower = (s.surface.lower[k] - shift) / factor + shift,
                 upper = (s.surface.upper[k] - shift) / factor + shift;
    if (upper < s.mesh.lower[k] || lower > s.mesh.upper[k]) return false;
  }
  return true;
}

double mesh_in_surfaces(const Situation &s) { return s.mesh.largest_side() / s.surface.largest_side(); }

bool sizes_fit_at(double factor, const Situation &s) {
  const double ratio = factor * mesh_in_surfaces(s);
  return ratio >= smallest_mesh && ratio <= largest_mesh &&
         factor * s.median_edge <= longest_edge * s.surface.largest_side();
}

bool is_parametric(const MarkOptions &options) { return options.surface.empty() && !is_valve_file(options.valve); }

// Returns whether the edges suit the default half thickness, which belongs to a parametric valve. If they are much longer, the
// mesh probably has another unit. But if the user named the unit, the mesh is only coarse.
bool edges_fit_at(double factor, const Situation &s) {
  return s.options.has_half_thickness || s.options.unit || s.options.has_scale || !is_parametric(s.options) ||
         !is_too_small(s.half_thickness / factor, s);
}

// Returns the factor that makes the mesh's lengths fit the surface's. Returns none if they already fit, or if no power of ten
// helps.
std::optional<double> missing_factor(const Situation &s) {
  const bool sizes_fit = sizes_fit_at(1, s);
  if (sizes_fit && edges_fit_at(1, s)) {
    // The unit is right in two cases: if the sizes are similar, or if they fit in units that the user named. Then only the
    // position can be wrong.
    const bool are_alike = mesh_in_surfaces(s) > 1.0 / 3 && mesh_in_surfaces(s) < 3;
    if (overlap_at(1, s) || are_alike || s.options.unit || s.options.has_scale) return std::nullopt;
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

// Returns the situation as it would be with the surface scaled to fit the mesh.
Situation rescaled(const Situation &s, double factor) {
  Situation changed = s;
  for (int k = 0; k < 3; ++k) {
    changed.surface.lower[k] /= factor;
    changed.surface.upper[k] /= factor;
  }
  changed.area /= factor * factor;
  return changed;
}

// Returns a half thickness that fits: the present one times a power of ten. If none fits, returns the mesh's edge length, or 0 if
// this length does not fit either.
double better_half_thickness(const Situation &s) {
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

}  // namespace

std::string shown(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", number);
  return text;
}

bool is_too_large(double half_thickness, const Situation &s) {
  return half_thickness > largest_half_thickness * s.surface.largest_side();
}

bool is_too_small(double half_thickness, const Situation &s) {
  return half_thickness < smallest_half_thickness * s.median_edge;
}

std::optional<Warning> warning_of_units(const Situation &s) {
  const auto factor = missing_factor(s);
  if (!factor) return std::nullopt;
  const Cure cure = cure_for_scale(s.options, s.options.surface_options.scale / *factor);
  std::string write = cure.write;
  if (s.options.has_half_thickness) {
    const Situation cured = rescaled(s, *factor);
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

}  // namespace riis::program
